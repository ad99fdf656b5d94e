//! A file, with the checksum of what is written to it.

use std::fs::File;
use std::io::{self, Write};

use xxhash_rust::xxh3::Xxh3Default;

use super::FileSum;

/// Writes to a file from its beginning or its end.
pub(super) struct Hashed {
    pub(super) file: File,
    hash: Xxh3Default,
    bytes: u64,
}

impl Hashed {
    /// An empty file.
    pub(super) fn new(file: File) -> Hashed {
        Hashed::after(file, Xxh3Default::new(), 0)
    }

    /// Goes on after the `bytes` in `file` whose hash is `hash`.
    pub(super) fn after(file: File, hash: Xxh3Default, bytes: u64) -> Hashed {
        Hashed { file, hash, bytes }
    }

    /// Bytes in the file.
    pub(super) fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Their hash.
    pub(super) fn digest(&self) -> u64 {
        self.hash.digest()
    }

    /// Both, as sidecars have them.
    pub(super) fn sum(&self) -> FileSum {
        FileSum { bytes: self.bytes, xxh3: format!("{:016x}", self.digest()) }
    }
}

impl Write for Hashed {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.file.write(bytes)?;
        self.hash.update(&bytes[..written]);
        self.bytes += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}
