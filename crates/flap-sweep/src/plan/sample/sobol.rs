//! Scrambled Sobol' sequences, one dimension at a time.

use super::joe_kuo::DIRECTIONS;

const BITS: usize = 32;

/// One dimension of a scrambled Sobol' sequence.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sobol {
    directions: [u32; BITS],
    key: u32,
}

impl Sobol {
    /// Dimension number `dimension`, from 0, scrambled with this key.
    pub(super) fn new(dimension: usize, key: u64) -> Sobol {
        // The upper half, of bits as good as any.
        let key = u32::try_from(key >> 32).unwrap_or(0);
        Sobol { directions: directions(dimension), key }
    }

    /// The coordinate of point number `index`, which must be less than 2^32: more than 0 and less than 1.
    pub(super) fn coordinate(&self, index: u64) -> f64 {
        (f64::from(scrambled(self.plain(index), self.key)) + 0.5) / (1_u64 << BITS) as f64
    }

    /// The digits of the sequence before they are scrambled. Points come in the order of Antonov and Saleev, in which
    /// each follows from the one before by one direction number.
    pub(super) fn plain(&self, index: u64) -> u32 {
        let gray = index ^ (index >> 1);
        let chosen = self.directions.iter().enumerate().filter(|(bit, _)| gray >> bit & 1 == 1);
        chosen.fold(0, |digits, (_, direction)| digits ^ direction)
    }
}

/// The direction numbers of a dimension, as binary fractions: the recurrence of Sobol', Bratley and Fox (1988), Eq. (2).
fn directions(dimension: usize) -> [u32; BITS] {
    let mut directions = [0; BITS];
    let Some((polynomial, first)) = dimension.checked_sub(1).and_then(|index| DIRECTIONS.get(index)) else {
        // The first dimension is the sequence of van der Corput.
        return std::array::from_fn(|bit| 1 << (BITS - 1 - bit));
    };
    let degree = first.len();
    for bit in 0..BITS {
        directions[bit] = if bit < degree {
            first[bit] << (BITS - 1 - bit)
        } else {
            let oldest = directions[bit - degree];
            (1..degree)
                .filter(|back| polynomial >> (degree - back) & 1 == 1)
                .fold(oldest ^ (oldest >> degree), |number, back| number ^ directions[bit - back])
        };
    }
    directions
}

/// Owen's nested uniform scrambling by a hash: each binary digit is flipped or not, as the digits before it decide.
///
/// The hash is that of Laine and Karras with the constants of Vegdahl, as in Burley, "Practical Hash-based Owen
/// Scrambling", JCGT 9(4) (2020). In it a bit depends on lower ones only, hence the reversals.
fn scrambled(digits: u32, key: u32) -> u32 {
    let mut x = digits.reverse_bits();
    x ^= x.wrapping_mul(0x3D20_ADEA);
    x = x.wrapping_add(key);
    x = x.wrapping_mul((key >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6C56);
    x ^= x.wrapping_mul(0x53A2_2864);
    x.reverse_bits()
}
