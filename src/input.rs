//! Files of bounded size: what a name leads to may have no end.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The bytes of a file.
///
/// # Errors
///
/// If the operating system refuses, or there are more than `most` bytes: of what has no end, such as a device, no more
/// than that is ever read.
pub fn read(path: &Path, most: usize) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    // One more than there may be tells the two apart.
    File::open(path)?.take(most as u64 + 1).read_to_end(&mut bytes)?;
    if bytes.len() > most { Err(too_large(most)) } else { Ok(bytes) }
}

/// The text of a file.
///
/// # Errors
///
/// As [`read`], and if the file is not UTF-8.
pub fn read_text(path: &Path, most: usize) -> io::Result<String> {
    String::from_utf8(read(path, most)?)
        .map_err(|error| io::Error::new(io::ErrorKind::InvalidData, format!("it is not UTF-8 text: {error}")))
}

/// What is said of input that has more than `most` bytes.
fn too_large(most: usize) -> io::Error {
    io::Error::new(
        io::ErrorKind::FileTooLarge,
        format!("it holds more than the {} MiB that are read", most >> 20),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_no_end_is_refused() {
        for endless in ["/dev/zero", "/dev/urandom"].map(Path::new).into_iter().filter(|path| path.exists()) {
            let error = read(endless, 1 << 20).expect_err("no end").to_string();
            assert!(error.contains("more than the 1 MiB"), "{error}");
        }
    }

    #[test]
    fn a_file_of_just_the_size_is_read() {
        let this = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src/input.rs"));
        let all = std::fs::read(this).expect("this file");
        assert_eq!(read(this, all.len()).expect("all of it"), all);
        assert!(read(this, all.len() - 1).is_err());
        assert_eq!(read_text(this, all.len()).expect("text").as_bytes(), all);
    }
}
