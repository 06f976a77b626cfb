use std::ffi::OsStr;
use std::path::Path;
use std::process::{Command, Stdio};

/// Bytes that are free where a folder is or would be made; `None` where the system does not tell.
pub fn free_disk(folder: &Path) -> Option<u64> {
    let folder = std::path::absolute(folder).ok()?;
    let there = folder.ancestors().find(|folder| folder.exists())?;
    let told = output_of("df", &["-Pk", there.to_str()?])?;
    // Of a file system: name, size, used, free, in kibibytes, on one line after that of the heads.
    let kibibytes: u64 = told.lines().nth(1)?.split_whitespace().nth(3)?.parse().ok()?;
    Some(1024 * kibibytes)
}

/// What a short-lived program says on standard output; `None` if it is not here or fails.
pub fn output_of(program: impl AsRef<OsStr>, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program)
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .ok()?;
    output
        .status
        .success()
        .then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_that_is_yet_to_be_made_has_the_room_of_the_one_above_it() {
        let here = free_disk(Path::new(".")).expect("df answers");
        let below = free_disk(Path::new("./not/made/yet")).expect("df answers");
        assert!(here > 0 && below > 0);
    }
}
