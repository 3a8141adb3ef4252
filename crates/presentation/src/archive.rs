//! Archives: several files as one, for browsers hand out one at a time.
//!
//! In: names and texts. Out: the bytes of a ZIP file. The files stand in it as they are, in order, without a date of
//! their own, so that the same files make the same archive.
//!
//! **Source:** PKWARE, *.ZIP File Format Specification*, 6.3.10, sections 4.3 and 4.4.

/// What a file's entry is of: the version that reads it, and names in UTF-8; stored as it is, on the first day.
const ENTRY: [u16; 5] = [20, 1 << 11, 0, 0, (1 << 5) | 1];

/// Makes an archive of files. At most 65 535 of them, 4 GB together, have room in one; any further are left out.
pub fn zip(files: &[(String, String)]) -> Vec<u8> {
    let (mut out, mut directory) = (Vec::new(), Vec::new());
    let mut count: u16 = 0;
    for (name, text) in files {
        let sizes = [crc(text.as_bytes()), size(text.len()), size(text.len())];
        let Some(next) = count.checked_add(1) else { break };
        count = next;
        let at = size(out.len());
        let entry = |out: &mut Vec<u8>| {
            ENTRY.iter().for_each(|word| out.extend(word.to_le_bytes()));
            sizes.iter().for_each(|word| out.extend(word.to_le_bytes()));
            out.extend((name.len() as u16).to_le_bytes());
            out.extend([0; 2]);
        };
        out.extend(b"PK\x03\x04");
        entry(&mut out);
        out.extend(name.as_bytes());
        out.extend(text.as_bytes());
        directory.extend(b"PK\x01\x02\x14\0");
        entry(&mut directory);
        // no comment, on the first disk, nothing said of it
        directory.extend([0; 10]);
        directory.extend(at.to_le_bytes());
        directory.extend(name.as_bytes());
    }
    let from = size(out.len());
    out.extend(&directory);
    out.extend(b"PK\x05\x06\0\0\0\0");
    out.extend(count.to_le_bytes());
    out.extend(count.to_le_bytes());
    out.extend(size(directory.len()).to_le_bytes());
    out.extend(from.to_le_bytes());
    out.extend([0; 2]);
    out
}

fn size(bytes: usize) -> u32 {
    u32::try_from(bytes).unwrap_or(u32::MAX)
}

/// The cyclic redundancy check of 32 bits, reflected, with the polynomial of Ethernet.
fn crc(bytes: &[u8]) -> u32 {
    let bit = |crc: u32, _| if crc & 1 == 1 { (crc >> 1) ^ 0xEDB8_8320 } else { crc >> 1 };
    !bytes.iter().fold(u32::MAX, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), bit))
}

#[cfg(test)]
mod tests {
    use super::{crc, zip};

    #[test]
    fn the_check_is_that_of_the_catalogue_of_such() {
        // the check value of CRC-32/ISO-HDLC
        assert_eq!(crc(b"123456789"), 0xCBF4_3926);
    }

    #[test]
    fn an_archive_lists_its_files_where_they_stand() {
        let files = [("a.svg", "<svg/>"), ("ü.svg", "")];
        let all = zip(&files.map(|(name, text)| (name.to_string(), text.to_string())));
        // 30 bytes before each name, 46 in the directory, 22 at its end
        assert_eq!(all.len(), (30 + 5 + 6) + (30 + 6) + (46 + 5) + (46 + 6) + 22);
        assert_eq!(&all[30..41], b"a.svg<svg/>");
        assert_eq!(&all[41..45], b"PK\x03\x04");
        let end = all.len() - 22;
        assert_eq!(&all[end..end + 4], b"PK\x05\x06");
        assert_eq!(&all[end + 10..end + 12], [2, 0]);
        assert_eq!(&all[end + 16..end + 20], [77, 0, 0, 0]);
        assert_eq!(&all[77..81], b"PK\x01\x02");
        // the second begins behind the first
        assert_eq!(&all[77 + 51 + 42..77 + 51 + 46], [41, 0, 0, 0]);
    }
}
