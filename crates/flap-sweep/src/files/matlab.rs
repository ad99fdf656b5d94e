//! Writes MAT files of version 5. MATLAB, Octave and `scipy.io.loadmat` can read these files.
//!
//! Variables in the MAT file are not compressed. Source: The MathWorks, MAT-File Format, chapter 1 (Level 5 MAT-File
//! Format).

use std::io::{self, Write};

use nalgebra::DMatrix;

/// A variable of a MAT file.
#[derive(Clone, Debug, PartialEq)]
pub enum Variable {
    /// Number.
    Number(f64),
    /// Column of numbers.
    Vector(Vec<f64>),
    /// Matrix of numbers.
    Matrix(DMatrix<f64>),
    /// Text: a row of characters.
    Text(String),
    /// Several texts, which are written as a cell array with one row.
    Texts(Vec<String>),
}

/// Codes of the data types in a MAT file.
const INT8: u32 = 1;
const INT32: u32 = 5;
const UINT32: u32 = 6;
const DOUBLE: u32 = 9;
const MATRIX: u32 = 14;
const UTF16: u32 = 17;

/// Classes of arrays.
const CELL: u32 = 1;
const CHAR: u32 = 4;
const NUMBERS: u32 = 6;

/// Length in bytes of the text at the beginning of a MAT file.
const TEXT_LENGTH: usize = 116;

/// Writes a MAT file that contains the given variables with their names.
///
/// # Errors
/// Returns the error of writing to `target`, or [`io::ErrorKind::InvalidInput`] if a variable has 4 GiB or
/// more.
pub fn write(variables: &[(&str, Variable)], target: &mut dyn Write) -> io::Result<()> {
    let mut header = b"MATLAB 5.0 MAT-file, created by flap".to_vec();
    header.resize(TEXT_LENGTH, b' ');
    // No data of a subsystem, the version, and the order of bytes.
    header.extend([0; 8]);
    header.extend(0x0100_u16.to_le_bytes());
    header.extend(b"IM");
    target.write_all(&header)?;
    for (name, variable) in variables {
        target.write_all(&array(name, variable)?)?;
    }
    Ok(())
}

/// Converts a variable into the bytes of a data element of a MAT file.
fn array(name: &str, variable: &Variable) -> io::Result<Vec<u8>> {
    match variable {
        Variable::Number(number) => numbers(name, &DMatrix::from_element(1, 1, *number)),
        Variable::Vector(vector) => numbers(name, &DMatrix::from_column_slice(vector.len(), 1, vector)),
        Variable::Matrix(matrix) => numbers(name, matrix),
        Variable::Text(text) => {
            let units: Vec<u16> = text.encode_utf16().collect();
            let rows = usize::from(!units.is_empty());
            let mut content = head(name, CHAR, [rows, units.len()])?;
            content.extend(element(UTF16, &bytes(units, u16::to_le_bytes))?);
            element(MATRIX, &content)
        }
        Variable::Texts(texts) => {
            let mut content = head(name, CELL, [1, texts.len()])?;
            for text in texts {
                content.extend(array("", &Variable::Text(text.clone()))?);
            }
            element(MATRIX, &content)
        }
    }
}

/// Converts a matrix into the bytes of a data element of a MAT file.
fn numbers(name: &str, matrix: &DMatrix<f64>) -> io::Result<Vec<u8>> {
    let mut content = head(name, NUMBERS, [matrix.nrows(), matrix.ncols()])?;
    // Columns are contiguous, as in nalgebra.
    content.extend(element(DOUBLE, &bytes(matrix.iter().copied(), f64::to_le_bytes))?);
    element(MATRIX, &content)
}

/// Returns the bytes that describe an array: its class, its dimensions and its name.
fn head(name: &str, class: u32, dimensions: [usize; 2]) -> io::Result<Vec<u8>> {
    let mut head = element(UINT32, &bytes([class, 0], u32::to_le_bytes))?;
    let dimensions = [size(dimensions[0])?, size(dimensions[1])?];
    head.extend(element(INT32, &bytes(dimensions, u32::to_le_bytes))?);
    head.extend(element(INT8, name.as_bytes())?);
    Ok(head)
}

/// Returns a data element: the type, the number of bytes, and the bytes. Zeros extend the element to a
/// multiple of eight bytes.
fn element(kind: u32, data: &[u8]) -> io::Result<Vec<u8>> {
    let length = size(data.len())?;
    // Up to four bytes are in the tag.
    let is_small = (1..=4).contains(&length);
    let tag = if is_small {
        bytes([kind | (length << 16)], u32::to_le_bytes)
    } else {
        bytes([kind, length], u32::to_le_bytes)
    };
    let mut element = tag;
    element.extend(data);
    element.resize(element.len().next_multiple_of(8), 0);
    Ok(element)
}

fn size(length: usize) -> io::Result<u32> {
    u32::try_from(length)
        .map_err(|_| io::Error::new(io::ErrorKind::InvalidInput, "the variable has 4 GiB or more"))
}

fn bytes<T, const N: usize>(values: impl IntoIterator<Item = T>, bytes: fn(T) -> [u8; N]) -> Vec<u8> {
    values.into_iter().flat_map(bytes).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_of_a_small_file() {
        let variables = [
            ("A", Variable::Matrix(DMatrix::from_row_slice(1, 2, &[1.0, -2.0]))),
            ("units", Variable::Texts(vec!["m".to_owned()])),
        ];
        let mut file = Vec::new();
        write(&variables, &mut file).unwrap();
        assert_eq!(file[..20], *b"MATLAB 5.0 MAT-file,");
        assert_eq!(file[124..128], [0, 1, b'I', b'M']);
        // Flags, dimensions, name and numbers.
        let matrix = [
            &[14, 0, 0, 0, 64, 0, 0, 0][..],
            &[6, 0, 0, 0, 8, 0, 0, 0, 6, 0, 0, 0, 0, 0, 0, 0],
            &[5, 0, 0, 0, 8, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0],
            &[1, 0, 1, 0, b'A', 0, 0, 0],
            &[9, 0, 0, 0, 16, 0, 0, 0],
            &1.0_f64.to_le_bytes(),
            &(-2.0_f64).to_le_bytes(),
        ];
        assert_eq!(file[128..200], matrix.concat());
        let cell = [
            &[14, 0, 0, 0, 104, 0, 0, 0][..],
            &[6, 0, 0, 0, 8, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0],
            &[5, 0, 0, 0, 8, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0],
            &[1, 0, 0, 0, 5, 0, 0, 0, b'u', b'n', b'i', b't', b's', 0, 0, 0],
            // The text has no name.
            &[14, 0, 0, 0, 48, 0, 0, 0],
            &[6, 0, 0, 0, 8, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0],
            &[5, 0, 0, 0, 8, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0],
            &[1, 0, 0, 0, 0, 0, 0, 0],
            &[17, 0, 2, 0, b'm', 0, 0, 0],
        ];
        assert_eq!(file[200..], cell.concat());
    }
}
