//! flap never overwrites inputs of a command, for any names of the files, even with `--force`.

use std::fmt::Write as _;
use std::fs;

use crate::support::{Folder, quick};

/// A folder with results, grid file, points and records, and links to each: `hard-NAME` and `soft-NAME`.
fn folder() -> Folder {
    let folder = Folder::with_grid(&quick(3));
    let sample = "preset = \"ozaki2018-large\"\n[sample]\nmethod = \"file\"\npath = \"points.csv\"\n[solver]\nmax_cycles = 1\n";
    fs::write(folder.path("sample.toml"), sample).unwrap();
    fs::write(folder.path("points.csv"), "drive_frequency\n60\n70\n").unwrap();
    let mut motion = "time_s,stroke_deg,pitch_deg,wave\n".to_owned();
    let mut images = "time_s,root_x,root_y,tip_x,tip_y\n".to_owned();
    for i in 0..20 {
        let (time, angle) = (1e-3 * f64::from(i), 0.3 * f64::from(i));
        let _ = writeln!(motion, "{time},{},{},{}", 10.0 * angle.sin(), 20.0 * angle.cos(), angle.sin());
        let _ = writeln!(images, "{time},0,0,{},{}", angle.cos(), angle.sin());
    }
    fs::write(folder.path("motion.csv"), motion).unwrap();
    fs::write(folder.path("images.csv"), images).unwrap();
    assert_eq!(folder.flap("sweep --grid grid.toml --out rows.csv").code, 0);
    assert_eq!(folder.flap("sweep --grid sample.toml --out sampled.csv").code, 0);
    for shard in ["1/2", "2/2"] {
        assert_eq!(folder.flap(&format!("sweep --grid grid.toml --shard {shard}")).code, 0);
    }
    for name in [
        "grid.toml",
        "points.csv",
        "motion.csv",
        "images.csv",
        "rows.csv",
        "grid.1of2.csv",
        "rows.csv.meta.toml",
    ] {
        let link = name.replace(".toml", ".csv");
        fs::hard_link(folder.path(name), folder.path(&format!("hard-{link}"))).unwrap();
        #[cfg(unix)]
        std::os::unix::fs::symlink(name, folder.path(&format!("soft-{link}"))).unwrap();
        #[cfg(not(unix))]
        fs::hard_link(folder.path(name), folder.path(&format!("soft-{link}"))).unwrap();
    }
    // The results `beside.csv` are not there, but their sidecar's name is taken by the grid file.
    fs::hard_link(folder.path("grid.toml"), folder.path("beside.csv.meta.toml")).unwrap();
    fs::hard_link(folder.path("rows.csv"), folder.path("shot.svg")).unwrap();
    fs::hard_link(folder.path("rows.csv"), folder.path("page.html")).unwrap();
    folder
}

/// Every file with its bytes.
fn contents(folder: &Folder) -> Vec<(String, Vec<u8>)> {
    let read = |name: String| {
        let bytes = fs::read(folder.path(&name)).unwrap();
        (name, bytes)
    };
    folder.names().into_iter().map(read).collect()
}

#[test]
fn no_command_overwrites_what_it_reads() {
    let folder = folder();
    let before = contents(&folder);
    for arguments in [
        "sweep --restart --grid grid.toml --out hard-grid.csv",
        "sweep --restart --grid grid.toml --out ./soft-grid.csv",
        "sweep --restart --grid grid.toml --out beside.csv",
        "sweep --restart --grid sample.toml --out points.csv",
        "sweep --restart --grid sample.toml --out hard-points.csv",
        "sweep --restart --grid sample.toml --out soft-points.csv",
        "sweep --grid sample.toml --out points.csv",
        "sweep --restart rows.csv.meta.toml --out rows.csv",
        "sweep --restart rows.csv.meta.toml --out hard-rows.csv.meta.csv",
        "sweep --restart sampled.csv.meta.toml --out soft-points.csv",
        "results rerun rows.csv --status unsettled --restart --out rows.csv",
        "results rerun rows.csv --status unsettled --restart --out hard-rows.csv",
        "results rerun rows.csv --status unsettled --restart --out soft-rows.csv.meta.csv",
        "results rerun sampled.csv --status unsettled --restart --out points.csv",
        "results merge --force grid.1of2.csv grid.1of2.csv grid.2of2.csv",
        "results merge --force soft-grid.1of2.csv grid.1of2.csv grid.2of2.csv",
        "results convert --force rows.csv rows.csv",
        "results convert --force rows.csv soft-rows.csv",
        "results convert --force sampled.csv hard-points.csv",
        "run grid.toml --force --trajectory hard-grid.csv",
        "run sample.toml --force --trajectory points.csv",
        "test chirp grid.toml --force --out soft-grid.csv",
        "run arabagi2013-75hz --waveform motion.csv --force --trajectory motion.csv",
        "run arabagi2013-75hz --stroke motion.csv --force --trajectory hard-motion.csv",
        "test impulse grid.toml --force --trajectory hard-grid.csv",
        "test lift ozaki2018-small motion.csv --force --trajectory motion.csv",
        "test lift ozaki2018-small motion.csv --force --trajectory soft-motion.csv",
        "test track images.csv --force --out images.csv",
        "test track images.csv --force --out hard-images.csv",
        "respond grid.toml --restart --out hard-grid.csv",
        "respond sample.toml --along drive_voltage_pp --from 50 --to 60 --step 5 --restart --out points.csv",
        "plot rows.csv --force --out shot.svg",
        "plot rows.csv --force --html page.html",
    ] {
        folder.refuses(arguments, " would overwrite ");
        assert!(contents(&folder) == before, "{arguments}");
    }
}

#[test]
fn two_outputs_are_two_files() {
    let folder = Folder::with_grid(&quick(3));
    let run = "test chirp ozaki2018-large --trajectory one.csv --out";
    for name in ["one.csv", "./one.csv"] {
        folder.ends(2, &format!("{run} {name}")).says("is the name of two outputs");
    }
    assert_eq!(folder.names(), ["grid.toml"]);
}

#[test]
fn results_given_as_a_grid_file_are_recognised() {
    let folder = Folder::with_grid(&quick(3));
    for ending in ["csv", "csv.zst", "parquet"] {
        assert_eq!(folder.flap(&format!("sweep --grid grid.toml --out rows.{ending}")).code, 0);
        let ended = folder.ends(2, &format!("check rows.{ending}"));
        assert_eq!(
            ended.stderr,
            format!(
                "error: rows.{ending} contains results and is not a grid file\n\
                 help: did you mean `flap plot rows.{ending}`?\n"
            )
        );
    }
    fs::File::create(folder.path("large.toml")).unwrap().set_len(1 << 30).unwrap();
    folder.ends(2, "check large.toml").says("at most 16 MiB are allowed");
}

#[test]
fn no_more_than_twenty_mistakes_are_shown() {
    let keys = (0..571).map(|number| format!("key_{number} = 1\n")).collect::<Vec<_>>().concat();
    let folder = Folder::with_grid(&format!("preset = \"ozaki2018-large\"\n[params]\n{keys}"));
    let ended = folder.ends(2, "check grid.toml");
    assert_eq!(ended.stderr.matches("error: ").count(), 20);
    let end = "\n\nand 551 more\n\ngrid.toml: 571 mistakes, nothing was run\n";
    assert!(ended.stderr.ends_with(end), "{}", ended.stderr);
}

/// A file of some kilobytes that decompresses to gigabytes without a line end.
#[test]
fn a_small_file_does_not_fill_the_memory() {
    let folder = Folder::with_grid(&quick(3));
    assert_eq!(folder.flap("sweep --grid grid.toml --out rows.csv.zst").code, 0);
    let megabyte = zstd::bulk::compress(&vec![b'1'; 1 << 20], 19).unwrap();
    let header = zstd::stream::decode_all(fs::File::open(folder.path("rows.csv.zst")).unwrap()).unwrap();
    let header = header.split_inclusive(|byte| *byte == b'\n').next().unwrap();
    let mut bomb = zstd::bulk::compress(header, 3).unwrap();
    for _ in 0..2000 {
        bomb.extend_from_slice(&megabyte);
    }
    assert!(bomb.len() < 1 << 20, "{}", bomb.len());
    fs::write(folder.path("rows.csv.zst"), bomb).unwrap();
    let commands = ["plot rows.csv.zst", "results rerun rows.csv.zst --status unsettled --out again.csv"];
    for arguments in commands {
        let ended = folder.flap(&format!("{arguments} --ignore-damage"));
        ended.says("rows.csv.zst is damaged");
    }
    // As an earlier flap has written it.
    folder.rewrite_sidecar("rows.csv.zst", |sidecar| sidecar.checksums = None);
    for arguments in commands {
        let ended = folder.flap(arguments);
        assert_ne!(ended.code, 0, "{arguments}");
        ended.says("a line is longer than 16 MiB");
    }
}

/// flap rejects an endless input, or an input larger than memory, by its size or kind. The rejection needs little
/// memory and little time.
#[test]
#[cfg(target_os = "linux")]
fn inputs_end() {
    let folder = Folder::with_grid("device = \"device.toml\"\n");
    fs::write(folder.path("sampled.toml"), sampled("points.csv")).unwrap();
    fs::write(folder.path("zeros.toml"), "device = \"/dev/zero\"\n").unwrap();
    fs::write(folder.path("zeros-sampled.toml"), sampled("/dev/zero")).unwrap();
    fs::write(folder.path("folder-sampled.toml"), sampled(".")).unwrap();
    fs::write(folder.path("folder-device.toml"), "device = \".\"\n").unwrap();
    let large = |name: &str, mebibytes: u64| {
        fs::File::create(folder.path(name)).unwrap().set_len(mebibytes << 20).unwrap();
    };
    for name in ["device.toml", "large.csv"] {
        large(name, 600);
    }
    for name in ["points.csv", "large.meta.toml"] {
        large(name, 1200);
    }
    let made = std::process::Command::new("mkfifo").arg(folder.path("pipe")).status().unwrap();
    assert!(made.success());
    fs::write(folder.path("pipe-device.toml"), "device = \"pipe\"\n").unwrap();
    fs::write(folder.path("pipe-sampled.toml"), sampled("pipe")).unwrap();

    let (size, listed) = ("the file is too large: at most 16 MiB", "the file is too large: at most 256 MiB");
    let (endless, is_folder) = ("this is a device or a pipe, not a file", "this is a folder");
    for (arguments, message) in [
        ("check grid.toml", size),
        ("check sampled.toml", listed),
        ("sweep large.meta.toml --out o.csv", listed),
        ("device wing large.csv --preset jafferis2016", size),
        ("run ozaki2018-large --waveform large.csv", size),
        ("test lift ozaki2018-small large.csv", size),
        ("test track large.csv", size),
        ("check /dev/zero", endless),
        ("run /dev/zero", endless),
        ("check zeros.toml", endless),
        ("check zeros-sampled.toml", endless),
        ("sweep /dev/zero --out o.csv", endless),
        ("device wing /dev/zero --preset jafferis2016", endless),
        ("device wing grid.csv --preset /dev/zero", endless),
        ("run ozaki2018-large --waveform /dev/zero", endless),
        ("run arabagi2013-75hz --stroke /dev/zero", endless),
        ("test lift ozaki2018-small /dev/zero", endless),
        ("test track /dev/zero", endless),
        ("check pipe", endless),
        ("check pipe-device.toml", endless),
        ("check pipe-sampled.toml", endless),
        ("sweep pipe --out o.csv", endless),
        ("device wing pipe --preset jafferis2016", endless),
        ("run ozaki2018-large --waveform pipe", endless),
        ("test lift ozaki2018-small pipe", endless),
        ("test track pipe", endless),
        ("check ./", is_folder),
        ("check folder-device.toml", is_folder),
        ("check folder-sampled.toml", is_folder),
        ("sweep ./ --out o.csv", is_folder),
        ("device wing ./ --preset jafferis2016", is_folder),
        ("run ozaki2018-large --waveform ./", is_folder),
        ("test lift ozaki2018-small ./", is_folder),
        ("test track ./", is_folder),
    ] {
        let ended = bounded(&folder, arguments);
        assert_eq!((ended.code, &*ended.stdout), (2, ""), "{arguments}: {}", ended.stderr);
        ended.says(message);
        assert!(!folder.path("o.csv").exists(), "{arguments}");
    }
}

/// A grid with the points of a file.
#[cfg(target_os = "linux")]
fn sampled(path: &str) -> String {
    format!("preset = \"ozaki2018-large\"\n[sample]\nmethod = \"file\"\npath = \"{path}\"\n")
}

/// Runs `flap` with 1.5 GB of address space and 20 seconds of processor time.
#[cfg(target_os = "linux")]
fn bounded(folder: &Folder, arguments: &str) -> crate::support::Ended {
    let flap = env!("CARGO_BIN_EXE_flap");
    folder.shell(&format!("ulimit -v 1500000 -t 20; exec {flap} {arguments}"))
}

/// flap reads pipes of the shell, which end with the command that writes to them.
#[test]
#[cfg(target_os = "linux")]
fn pipes_of_the_shell_are_read() {
    let folder = Folder::with_grid(&quick(3));
    let flap = env!("CARGO_BIN_EXE_flap");
    for command in ["check <(cat grid.toml)", "check /dev/stdin < grid.toml"] {
        let ended = folder.shell(&format!("{flap} {command}"));
        assert_eq!(ended.code, 0, "{command}: {}", ended.stderr);
        ended.prints("3 points");
    }
    let ended = folder.shell(&format!("cat grid.toml | {flap} check /dev/stdin"));
    assert_eq!(ended.code, 0, "{}", ended.stderr);
}

/// flap needs memory in proportion to the length of a line with a million commas.
#[test]
#[cfg(target_os = "linux")]
fn long_lines_of_points_are_refused() {
    let folder = Folder::with_grid(&sampled("points.csv"));
    fs::write(folder.path("points.csv"), format!("drive_frequency\n60\n{}\n", ",".repeat(100 << 20)))
        .unwrap();
    let ended = bounded(&folder, "check grid.toml");
    assert_eq!(ended.code, 2, "{}", ended.stderr);
    ended.says("points.csv:3:1").says("a line of points has at most 1048576");
}
