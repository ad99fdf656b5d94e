# Formula for Homebrew. scripts/fill-recipes.sh replaces the words between @ signs by the values of a release.
class Flap < Formula
  desc "Parameter sweeps of insect-scale piezoelectric flapping-wing actuators"
  homepage "@REPOSITORY@"
  url "@REPOSITORY@/releases/download/v@VERSION@/flapwing-@VERSION@.tar.gz"
  sha256 "@SHA256@"
  license any_of: ["MIT", "Apache-2.0"]

  depends_on "rust" => :build

  def install
    system "cargo", "install", *std_cargo_args(path: "crates/flap-cli")
    generate_completions_from_executable(bin/"flap", "generate", "completions")
  end

  test do
    (testpath/"grid.toml").write <<~TOML
      preset = "ozaki2018-large"
      [axes]
      drive_voltage_pp = { from = 60, to = 120, n = 4 }
    TOML
    system bin/"flap", "sweep", "grid.toml", "--out", "rows.csv"
    assert_equal 4, (testpath/"rows.csv").read.scan(",periodic,").length
  end
end
