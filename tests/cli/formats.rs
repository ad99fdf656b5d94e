//! Rows as CSV, compressed CSV and Parquet.

use std::fs;

use flap_sweep::files::sidecar::Sidecar;

use crate::support::{Folder, frequencies, quick};

const ENDINGS: [&str; 3] = ["csv", "csv.zst", "parquet"];

/// More rows than one compressed frame contains, with all kinds of cells: words, numbers, and empty cells.
fn grid() -> String {
    quick(700) + "[[zip]]\nadded_mass = [\"paper\", \"lagrangian\"]\n"
}

#[test]
fn every_format_holds_the_same_rows() {
    let folder =
        Folder::with_grid(&(frequencies(20) + "[[zip]]\nadded_mass = [\"paper\", \"lagrangian\"]\n"));
    for ending in ENDINGS {
        let ended = folder.ends(0, &format!("sweep --grid grid.toml --out rows.{ending}"));
        assert!(ended.stderr.ends_with(&format!("40 rows in rows.{ending}\n")), "{}", ended.stderr);
        let sidecar: toml::Table = folder.read(&format!("rows.{ending}.meta.toml")).parse().unwrap();
        assert_eq!(sidecar["state"].as_str(), Some("complete"));
        folder.ends(0, &format!("results convert rows.{ending} from-{ending}.csv"));
        assert_eq!(folder.read("rows.csv"), folder.read(&format!("from-{ending}.csv")));
    }
    for left in ["rows.csv.journal", "rows.parquet.journal", "rows.parquet.part"] {
        assert!(!folder.path(left).exists(), "{left}");
    }
}

#[test]
fn converted_files_have_the_bytes_of_written_ones() {
    let folder = Folder::with_grid(&grid());
    for ending in ENDINGS {
        assert_eq!(folder.flap(&format!("sweep --grid grid.toml --out {ending}.{ending}")).code, 0);
    }
    for from in ENDINGS {
        for to in ENDINGS {
            let ended = folder.flap(&format!("results convert {from}.{from} out.{to} --force"));
            assert_eq!(ended.code, 0, "{from} to {to}: {}", ended.stderr);
            assert_eq!(ended.stdout, "");
            let bytes = |name: &str| fs::read(folder.path(name)).unwrap();
            assert!(bytes(&format!("{to}.{to}")) == bytes(&format!("out.{to}")), "{from} to {to}");
            let sidecar = |name: &str| Sidecar::read(&folder.path(&format!("{name}.meta.toml"))).unwrap();
            // But for the checksum of the file's bytes, which are those of another format.
            let (mut before, after) = (sidecar(&format!("{from}.{from}")), sidecar(&format!("out.{to}")));
            before.checksums.as_mut().unwrap().file = after.checksums.as_ref().unwrap().file.clone();
            assert_eq!(before, after);
            assert_eq!(after.checksums, sidecar(&format!("{to}.{to}")).checksums);
        }
    }
    let size = |name: &str| fs::metadata(folder.path(name)).unwrap().len();
    assert!(size("csv.zst.csv.zst") * 3 < size("csv.csv"), "compressed");
}

/// `zstd -d` restores the CSV file, and the compressed file has more than one frame.
#[test]
fn compressed_files_are_frames_of_plain_ones() {
    let folder = Folder::with_grid(&quick(600));
    for ending in ["csv", "csv.zst"] {
        assert_eq!(folder.flap(&format!("sweep --grid grid.toml --out rows.{ending}")).code, 0);
    }
    let compressed = fs::read(folder.path("rows.csv.zst")).unwrap();
    let magic = [0x28, 0xb5, 0x2f, 0xfd];
    let frames = compressed.windows(4).filter(|bytes| *bytes == magic).count();
    assert_eq!(frames, 1 + 3, "a header and three blocks");
    assert_ne!(compressed[magic.len()] & 4, 0, "a frame ends in its checksum");
    assert_eq!(zstd::decode_all(&compressed[..]).unwrap(), fs::read(folder.path("rows.csv")).unwrap());
}

#[test]
fn parquet_carries_types_units_and_provenance() {
    use parquet::basic::Type;
    use parquet::file::reader::{FileReader, SerializedFileReader};

    let folder = Folder::with_grid(&grid());
    assert_eq!(folder.flap("sweep --grid grid.toml --out rows.parquet").code, 0);
    let file = fs::File::open(folder.path("rows.parquet")).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    let metadata = reader.metadata().file_metadata();
    assert_eq!(metadata.num_rows(), 1400);
    let physical = |name: &str| {
        let fields = metadata.schema().get_fields();
        fields.iter().find(|field| field.name() == name).unwrap().get_physical_type()
    };
    assert_eq!(physical("point"), Type::INT64);
    assert_eq!(physical("drive_frequency"), Type::DOUBLE);
    assert_eq!(physical("added_mass"), Type::BYTE_ARRAY);
    assert_eq!(physical("status"), Type::BYTE_ARRAY);
    assert_eq!(physical("stable"), Type::BOOLEAN);
    assert_eq!(physical("lift_mean_mn"), Type::DOUBLE);

    let entries = metadata.key_value_metadata().unwrap();
    let entry = |key: &str| {
        let entry = entries.iter().find(|entry| entry.key == key);
        entry.unwrap_or_else(|| panic!("{key}")).value.clone().unwrap()
    };
    assert_eq!(entry("flap.preset"), "ozaki2018-large");
    assert_eq!(entry("flap.grid"), grid());
    let units: toml::Table = entry("flap.units").parse().unwrap();
    assert_eq!(units["lift_mean_mn"].as_str(), Some("mN"));
    let solver: toml::Table = entry("flap.solver").parse().unwrap();
    assert_eq!(solver["max_cycles"].as_integer(), Some(1));
    let parameters: toml::Table = entry("flap.parameters").parse().unwrap();
    assert!(parameters.contains_key("hinge_stiffness"));
    assert!(!entry("flap").is_empty() && !entry("flap.arithmetic").is_empty());
}

/// A grid whose rows have more columns after the model's columns: columns of the resonance, and columns of `[measure]`.
#[test]
fn every_format_holds_the_columns_of_resonances_and_own_measures() {
    use parquet::basic::Type;
    use parquet::file::reader::{FileReader, SerializedFileReader};

    let folder = Folder::with_grid(
        r#"
preset = "ozaki2018-large"
[params]
drive_frequency = "resonance"
[resonance]
from = "90 Hz"
to = "130 Hz"
tolerance = "1 Hz"
[axes]
drive_voltage_pp = [20, 30]
[measure]
speed = "resonance_hz * stroke_amplitude_deg"
high = "resonance_hz > 50"
"#,
    );
    for ending in ENDINGS {
        folder.ends(0, &format!("sweep --grid grid.toml --out rows.{ending} --strict"));
        folder.ends(0, &format!("results convert rows.{ending} from-{ending}.csv"));
        assert_eq!(folder.read("rows.csv"), folder.read(&format!("from-{ending}.csv")));
    }
    let text = folder.read("rows.csv");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    let place = |name: &str| rows[0].iter().position(|column| *column == name).unwrap();
    for row in &rows[1..] {
        let number = |name: &str| row[place(name)].parse::<f64>().unwrap();
        assert!((90.0..=130.0).contains(&number("resonance_hz")), "{row:?}");
        assert_eq!(number("speed"), number("resonance_hz") * number("stroke_amplitude_deg"));
        assert_eq!(row[place("high")], "true");
    }

    let reader = SerializedFileReader::new(fs::File::open(folder.path("rows.parquet")).unwrap()).unwrap();
    let fields = reader.metadata().file_metadata().schema().get_fields();
    let names: Vec<&str> = fields.iter().map(|field| field.name()).collect();
    assert_eq!(names, rows[0]);
    assert_eq!(fields[place("resonance_hz")].get_physical_type(), Type::DOUBLE);
    assert_eq!(fields[place("speed")].get_physical_type(), Type::DOUBLE);
    assert_eq!(fields[place("high")].get_physical_type(), Type::BOOLEAN);
}

#[test]
fn endings_that_stand_for_no_format() {
    let folder = Folder::with_grid(&quick(1));
    let ended = folder.ends(2, "sweep --grid grid.toml --out rows.xlsx");
    assert_eq!(ended.stderr, "error: rows.xlsx: the file name must end in .csv, .csv.zst or .parquet\n");
    assert_eq!(folder.flap("sweep --grid grid.toml --out rows.csv").code, 0);
    fs::copy(folder.path("rows.csv"), folder.path("rows.tsv")).unwrap();
    fs::write(folder.path("at.toml"), quick(1) + "[output]\npath = \"rows.json\"\n").unwrap();
    let rows = ".csv, .csv.zst or .parquet";
    for (arguments, allowed) in [
        ("sweep --grid grid.toml --out rows.csv.gz", rows),
        ("sweep --grid grid.toml --out rows.zst", rows),
        ("sweep --grid grid.toml --out rows", rows),
        ("sweep --grid at.toml", rows),
        ("check at.toml", rows),
        ("results resume rows.tsv", rows),
        ("results rerun rows.csv --status unsettled --out rows.json", rows),
        ("results rerun rows.tsv --status unsettled --out again.csv", rows),
        ("results convert rows.csv rows.tsv", rows),
        ("results convert rows.tsv out.csv", rows),
        ("results merge rows.xlsx rows.csv", rows),
        ("run ozaki2018-large --trajectory motion.parquet", ".csv"),
        ("test chirp ozaki2018-large --out envelope.tsv", ".csv"),
        ("respond ozaki2018-large --from 90 --to 100 --step 5 --out rows.tsv", rows),
        ("plot rows.tsv", rows),
        ("plot rows.csv --out picture.pdf", ".svg or .png"),
        ("plot rows.csv --html page.txt", ".html or .htm"),
    ] {
        let ended = folder.ends(2, arguments);
        let told = ended.stderr.lines().next().unwrap();
        assert!(told.ends_with(allowed), "{arguments}: {told}");
    }
}

/// Endings in capital letters are valid too.
#[test]
fn endings_are_those_of_any_system() {
    let folder = Folder::with_grid(&quick(3));
    for name in ["A.CSV", "B.CSV.ZST", "C.Parquet"] {
        assert_eq!(folder.flap(&format!("sweep --grid grid.toml --out {name}")).code, 0);
        assert_eq!(folder.flap(&format!("results convert {name} {name}.csv")).code, 0);
        assert_eq!(folder.read("A.CSV"), folder.read(&format!("{name}.csv")), "{name}");
    }
}

#[test]
fn rows_are_converted_and_merged_to_stdout() {
    let folder = Folder::with_grid(&grid());
    for ending in ENDINGS {
        assert_eq!(folder.flap(&format!("sweep --grid grid.toml --out rows.{ending}")).code, 0);
        let ended = folder.flap(&format!("results convert rows.{ending} -"));
        assert_eq!((ended.code, ended.stderr.as_str()), (0, ""));
        assert!(ended.stdout == folder.read("rows.csv"), "{ending}");
    }
    for shard in ["1/2", "2/2"] {
        assert_eq!(folder.flap(&format!("sweep --grid grid.toml --shard {shard}")).code, 0);
    }
    let ended = folder.flap("results merge - grid.1of2.csv grid.2of2.csv");
    assert_eq!((ended.code, ended.stderr.as_str()), (0, ""));
    assert!(ended.stdout == folder.read("rows.csv"));
    assert!(!folder.path("-").exists());
}

#[test]
fn what_cannot_be_converted() {
    let folder = Folder::with_grid(&quick(10));
    assert_eq!(folder.flap("sweep --grid grid.toml --out rows.csv").code, 0);
    fs::write(folder.path("alone.csv"), folder.read("rows.csv")).unwrap();
    folder
        .ends(2, "results convert alone.csv out.parquet")
        .says("alone.csv.meta.toml: there is no such file");

    folder
        .ends(2, "results convert rows.csv rows.csv")
        .says("writing rows.csv would overwrite the results rows.csv");

    fs::write(folder.path("rows.csv"), "point,other\n0,1\n").unwrap();
    folder.rewrite_sidecar("rows.csv", |sidecar| sidecar.checksums = None);
    folder
        .ends(3, "results convert rows.csv out.parquet")
        .says("its columns differ from the columns of the grid in its sidecar");
    assert!(!folder.path("out.parquet").exists());
}
