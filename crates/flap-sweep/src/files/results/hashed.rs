//! A file, with the checksum of the bytes written to it.

use std::fs::File;
use std::io::{self, Write};

use xxhash_rust::xxh3::Xxh3Default;

use super::FileSum;
use crate::notation::text::digits;

/// A file that is written from its beginning or its end, with the checksum of its bytes.
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

    /// A file that holds `bytes` bytes already, whose hash is `hash`.
    pub(super) fn after(file: File, hash: Xxh3Default, bytes: u64) -> Hashed {
        Hashed { file, hash, bytes }
    }

    /// Number and checksum of the bytes in the file.
    pub(super) fn sum(&self) -> FileSum {
        FileSum { bytes: self.bytes, xxh3: digits(self.hash.digest()) }
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
