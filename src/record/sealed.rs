//! A sealed file: HDF5 behind a short text header with kind, format, case and a checksum over all of it.
//!
//! The header stands in the user block that HDF5 leaves to the application, so `head -3 FILE` shows it and every
//! HDF5 program opens the file as it is. The checksum is verified before HDF5 sees a byte: a damaged file never
//! reaches the library.

use std::fs::OpenOptions;
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::Path;

use hdf5::Group;

use super::{RecordError, aside, file};
use crate::durable;

/// Length of the header, bytes; the smallest user block of HDF5.
const HEADER: usize = 512;

/// What a sealed file says it is.
#[derive(Clone, Copy)]
pub(super) struct Seal<'a> {
    /// One word or two, such as `checkpoint`.
    pub kind: &'static str,
    /// Raised whenever the layout changes.
    pub format: u32,
    /// Case the file belongs to; empty where the folder says so already.
    pub case_id: &'a str,
}

/// Writes a file whose HDF5 part `fill` fills, and puts it in place by one rename.
pub(super) fn write(path: &Path, seal: Seal, fill: impl FnOnce(&Group) -> hdf5::Result<()>) -> Result<(), RecordError> {
    aside::replace(path, |aside| {
        fill_hdf5(aside, fill).map_err(|cause| RecordError::cannot_write(path, cause))?;
        seal.sign(aside).map_err(|cause| RecordError::cannot_write(path, cause))
    })
}

/// Opens a file that `write` made, once its seal is verified.
pub(super) fn open(path: &Path, seal: Seal) -> Result<hdf5::File, RecordError> {
    let reading = |cause| RecordError::reading(path, &cause);
    let mut file = durable::open(path).map_err(reading)?;
    let mut header = Vec::with_capacity(HEADER);
    (&mut file)
        .take(HEADER as u64)
        .read_to_end(&mut header)
        .map_err(reading)?;
    let body = |identity: &str| checksum(identity, &mut file).map_err(reading);
    seal.verify(path, &header, body)?;
    file::open(path).map_err(|cause| RecordError::cannot_read(path, cause))
}

fn fill_hdf5(path: &Path, fill: impl FnOnce(&Group) -> hdf5::Result<()>) -> hdf5::Result<()> {
    let file = file::create(path, HEADER as u64)?;
    fill(&file)?;
    file::finish(file)
}

impl Seal<'_> {
    fn sign(self, path: &Path) -> std::io::Result<()> {
        let mut file = OpenOptions::new().read(true).write(true).open(path)?;
        file.seek(SeekFrom::Start(HEADER as u64))?;
        let identity = self.identity();
        let mut header = format!("{identity}{}\n", checksum(&identity, &mut file)?).into_bytes();
        if header.len() > HEADER {
            return Err(std::io::Error::other(format!(
                "the case id `{}` is too long",
                self.case_id
            )));
        }
        header.resize(HEADER, 0);
        file.seek(SeekFrom::Start(0))?;
        file.write_all(&header)
    }

    /// `sum` gives the checksum of what follows the header.
    fn verify(
        self,
        path: &Path,
        bytes: &[u8],
        sum: impl FnOnce(&str) -> Result<String, RecordError>,
    ) -> Result<(), RecordError> {
        let not_ours = || RecordError::NotOurs {
            path: path.to_owned(),
            expected: self.kind,
        };
        let cut_short = || RecordError::damaged(path, "it is cut short");

        let title = format!("cgaft {} ", self.kind);
        if !bytes.starts_with(title.as_bytes()) {
            return Err(if title.as_bytes().starts_with(bytes) {
                cut_short()
            } else {
                not_ours()
            });
        }
        if bytes.len() < HEADER {
            return Err(cut_short());
        }
        let mut lines = bytes
            .split_inclusive(|byte| *byte == b'\n')
            .map(String::from_utf8_lossy);
        let [first, case, signed] = std::array::from_fn(|_| lines.next().unwrap_or_default());

        let format = first[title.len()..].trim_end();
        if format != self.format.to_string() {
            let (kind, found, readable) = (self.kind, format.to_owned(), self.format);
            return Err(RecordError::OtherFormat {
                path: path.to_owned(),
                kind,
                found,
                readable,
            });
        }
        if signed.trim_end() != sum(&format!("{first}{case}"))? {
            return Err(RecordError::damaged(path, "its checksum does not match its content"));
        }
        let case = case.trim_start_matches("case ").trim_end();
        if case != self.case_id {
            let (found, expected) = (case.to_owned(), self.case_id.to_owned());
            return Err(RecordError::OtherCase {
                path: path.to_owned(),
                found,
                expected,
            });
        }
        Ok(())
    }

    fn identity(self) -> String {
        format!("cgaft {} {}\ncase {}\n", self.kind, self.format, self.case_id)
    }
}

fn checksum(identity: &str, body: impl Read) -> std::io::Result<String> {
    let mut hasher = blake3::Hasher::new();
    hasher.update(identity.as_bytes()).update_reader(body)?;
    Ok(format!("blake3 {}", hasher.finalize()))
}
