//! Changes of inputs, which are the same in every run.

/// Pieces of text with a meaning in the languages under test.
const PIECES: [&str; 52] = [
    "\n",
    "\"",
    "'",
    "[",
    "]",
    "{",
    "}",
    "=",
    ",",
    "#",
    ".",
    "-",
    "+",
    "*",
    "/",
    "^",
    "(",
    ")",
    "<=",
    "!=",
    " and ",
    " or ",
    "not ",
    "preset.",
    "nan",
    "inf",
    "1e308",
    "1e-308",
    "9223372036854775807",
    "0",
    "-1",
    "true",
    "\u{b5}",
    "\u{3a9}",
    "\u{0}",
    "\\u0000",
    "[axes]\n",
    "[[zip]]\n",
    "resonance",
    "µN·m/rad",
    "\"\"\"",
    "]]",
    "* 1e300",
    "1e999",
    "mean = 0",
    "to = 1",
    "n = 2",
    "step = 0",
    "wing_length",
    " V",
    "\\u00b5",
    "\u{feff}",
];

/// Makes inputs by changing inputs of a corpus.
pub(crate) struct Mutator<'a> {
    corpus: &'a [Vec<u8>],
    state: u64,
}

impl<'a> Mutator<'a> {
    pub(crate) fn new(corpus: &'a [Vec<u8>]) -> Mutator<'a> {
        Mutator { corpus, state: 0x9E37_79B9_7F4A_7C15 }
    }

    /// A whole number below `limit`, or 0 (xorshift).
    fn below(&mut self, limit: usize) -> usize {
        self.state ^= self.state << 13;
        self.state ^= self.state >> 7;
        self.state ^= self.state << 17;
        usize::try_from(self.state >> 33).unwrap_or(0) % limit.max(1)
    }

    /// Returns an input of the corpus with a few changes.
    pub(crate) fn next(&mut self) -> Vec<u8> {
        let mut input = self.corpus[self.below(self.corpus.len())].clone();
        for _ in 0..=self.below(4) {
            self.change(&mut input);
        }
        input
    }

    fn change(&mut self, input: &mut Vec<u8>) {
        let at = self.below(input.len() + 1);
        let end = (at + 1 + self.below(12)).min(input.len());
        match self.below(6) {
            0 => {
                input.drain(at.min(end)..end);
            }
            1 => {
                let piece = PIECES[self.below(PIECES.len())];
                input.splice(at..at, piece.bytes());
            }
            2 => {
                let piece = PIECES[self.below(PIECES.len())];
                input.splice(at.min(end)..end, piece.bytes());
            }
            3 => {
                let other = &self.corpus[self.below(self.corpus.len())];
                let from = self.below(other.len());
                let to = (from + self.below(80)).min(other.len());
                input.splice(at..at, other[from..to].iter().copied());
            }
            4 => {
                let copied = input[at.min(end)..end].to_vec();
                let times = 1 + self.below(200);
                input.splice(at..at, copied.repeat(times));
            }
            _ => {
                if let Some(byte) = input.get_mut(at) {
                    *byte ^= 1 << (at % 8);
                }
            }
        }
    }
}
