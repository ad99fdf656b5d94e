//! ZIP archives of texts that are not compressed.
//!
//! The bytes of an archive depend only on names and texts: every file has the date 1980-01-01. Source: PKWARE,
//! APPNOTE.TXT, .ZIP File Format Specification, version 6.3.10, sections 4.3 and 4.4.

use std::io;

/// Version of the format, names in UTF-8, no compression, midnight, 1 January 1980.
const VERSION_TO_DATE: [u16; 5] = [10, 1 << 11, 0, 0, (1 << 5) | 1];

/// Returns an archive of files with the given names and texts.
///
/// # Errors
/// An error if the archive is too large for the format.
pub(super) fn archive(files: &[(&str, &str)]) -> io::Result<Vec<u8>> {
    let (mut archive, mut directory) = (Vec::new(), Vec::new());
    for (name, text) in files {
        let offset = size(archive.len())?;
        let mut entry = VERSION_TO_DATE.map(u16::to_le_bytes).concat();
        // The length without compression follows the equal length in the archive.
        let numbers = [crc32fast::hash(text.as_bytes()), size(text.len())?, size(text.len())?];
        entry.extend(numbers.map(u32::to_le_bytes).concat());
        // No extra field.
        entry.extend([count(name.len())?, 0].map(u16::to_le_bytes).concat());
        archive.extend([b"PK\x03\x04", &*entry, name.as_bytes(), text.as_bytes()].concat());
        // The version of the writer precedes the entry. Comment, disk and attributes are zero.
        directory.extend([&b"PK\x01\x02\x0a\0"[..], &*entry, &[0; 10]].concat());
        directory.extend([&offset.to_le_bytes(), name.as_bytes()].concat());
    }
    let (number, start) = (count(files.len())?, size(archive.len())?);
    archive.extend(&directory);
    archive.extend(b"PK\x05\x06");
    archive.extend([0, 0, number, number].map(u16::to_le_bytes).concat());
    archive.extend([size(directory.len())?, start].map(u32::to_le_bytes).concat());
    // No comment.
    archive.extend([0; 2]);
    Ok(archive)
}

fn size(length: usize) -> io::Result<u32> {
    u32::try_from(length).map_err(io::Error::other)
}

fn count(length: usize) -> io::Result<u16> {
    u16::try_from(length).map_err(io::Error::other)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_of_a_small_archive() {
        let expected = [
            &b"PK\x03\x04\x0a\0\0\x08\0\0\0\0\x21\0"[..],
            &[0x43, 0xbe, 0xb7, 0xe8, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0],
            b"na",
            b"PK\x01\x02\x0a\0\x0a\0\0\x08\0\0\0\0\x21\0",
            &[0x43, 0xbe, 0xb7, 0xe8, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0],
            &[0; 14],
            b"n",
            b"PK\x05\x06\0\0\0\0\x01\0\x01\0\x2f\0\0\0\x20\0\0\0\0\0",
        ];
        assert_eq!(archive(&[("n", "a")]).unwrap(), expected.concat());
    }
}
