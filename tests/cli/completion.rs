//! Completion in shells.

use std::fs::File;
use std::process::Command;
use std::time::{Duration, Instant};

use crate::support::{Folder, frequencies};

const FLAP: &str = env!("CARGO_BIN_EXE_flap");

/// The candidates for the last word of a command line, as `shell` gets them.
fn candidates(folder: &Folder, shell: &str, line: &str) -> Vec<String> {
    let words: Vec<&str> = line.split(' ').collect();
    let output = Command::new(FLAP)
        .env("COMPLETE", shell)
        .env("_CLAP_IFS", "\n")
        .env("_CLAP_COMPLETE_INDEX", (words.len() - 1).to_string())
        .arg("--")
        .args(words)
        .current_dir(folder.path(""))
        .output()
        .unwrap();
    assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
    String::from_utf8(output.stdout).unwrap().lines().map(ToOwned::to_owned).collect()
}

#[test]
fn every_shell_completes_commands_and_options() {
    let folder = Folder::new();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = folder.ends(0, &format!("generate completions {shell}")).stdout;
        assert!(script.contains("COMPLETE") && script.contains(FLAP), "{shell}: {script}");
        for (line, wanted) in [
            ("flap ", &["sweep", "models", "test"][..]),
            ("flap run x --max", &["--max-cycles"]),
            ("flap sweep --q", &["--quiet"]),
            ("flap generate completions ", &["bash", "zsh", "fish", "powershell", "elvish"]),
        ] {
            let found = candidates(&folder, shell, line);
            for word in wanted {
                // Most shells get the meaning behind the word.
                let is_there =
                    found.iter().any(|candidate| candidate.split([':', '\t']).next() == Some(word));
                assert!(is_there, "{shell}: {line}: {word} is not among {found:?}");
            }
        }
    }
}

/// A shell waits for the candidates, so flap reads only the header, not a terabyte of rows or the checksums in the
/// sidecar.
#[test]
fn columns_come_from_the_header() {
    let folder = Folder::with_grid(&frequencies(3));
    for name in ["rows.csv", "rows.csv.zst"] {
        folder.ends(0, &format!("sweep grid.toml --out {name}"));
        let rows = File::options().write(true).open(folder.path(name)).unwrap();
        rows.set_len(1 << 40).unwrap();
        let begun = Instant::now();
        let found = candidates(&folder, "bash", &format!("flap top {name} --by lift_mean_m"));
        assert_eq!(found.join(" "), "lift_mean_mn", "{name}");
        assert!(begun.elapsed() < Duration::from_secs(60), "{name}");
    }
}

#[test]
fn names_are_completed() {
    let folder = Folder::with_grid(&frequencies(3));
    folder.ends(0, "sweep grid.toml --out rows.csv");
    folder.ends(0, "results convert rows.csv rows.parquet");
    for (line, wanted) in [
        ("flap run jaff", "jafferis2016 jafferis2016-improved"),
        ("flap run gri", "grid.toml"),
        ("flap models four", "four-bar"),
        ("flap generate schema --preset ozaki2018-l", "ozaki2018-large ozaki2018-large-kw-swapped"),
        ("flap run ozaki2018-large --set hinge_stiffn", "hinge_stiffness="),
        ("flap run ozaki2018-large --each hinge_stiffn", "hinge_stiffness="),
        ("flap run ozaki2018-large --set transmission_", ""),
        (
            "flap run jafferis2016 --set transmission_",
            "transmission_ratio= transmission_stiffness= transmission_growth=",
        ),
        ("flap run grid.toml --set transmission_", ""),
        ("flap run grid.toml --set centre_of_pressure=f", "centre_of_pressure=folded"),
        ("flap respond jafferis2016 --along transmission_r", "transmission_ratio"),
        ("flap run jafferis2016 --gradient lift_mean_", "lift_mean_mn lift_mean_gf"),
        ("flap top rows.csv --by lift_mean_m", "lift_mean_mn"),
        ("flap top rows.csv --by strain_mid", ""),
        ("flap top rows.parquet --by drive_", "drive_frequency"),
        ("flap top rows.csv --by lift_mean_mn --columns period,stab", "period,stable"),
        ("flap top rows.csv --by lift_mean_mn --where stat", "status="),
        ("flap results rerun rows.csv --status unsettled,step", "unsettled,step_limit"),
        ("flap models floq", "floquet_max"),
        ("flap models unsett", "unsettled"),
        ("flap models series_", "series_stiffness"),
    ] {
        assert_eq!(candidates(&folder, "bash", line).join(" "), wanted, "{line}");
    }
}

/// The completion script works in bash.
#[test]
#[cfg(unix)]
fn bash_completes_with_the_script() {
    let folder = Folder::with_grid(&frequencies(3));
    folder.ends(0, "sweep grid.toml --out rows.csv");
    std::fs::write(folder.path("flap.bash"), folder.ends(0, "generate completions bash").stdout).unwrap();
    let script = "source flap.bash
        COMP_WORDS=(flap top rows.csv --by lift_me) COMP_CWORD=4 COMP_TYPE=9
        _clap_complete_flap flap lift_me --by
        echo \"${COMPREPLY[@]}\"";
    let output = Command::new("bash").args(["-c", script]).current_dir(folder.path("")).output().unwrap();
    assert_eq!(String::from_utf8(output.stdout).unwrap(), "lift_mean_mn lift_mean_gf\n");
}
