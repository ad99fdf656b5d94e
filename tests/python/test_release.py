"""The scripts and workflows of releases."""

import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import yaml

REPOSITORY = Path(__file__).parents[2]
WORKFLOWS = sorted((REPOSITORY / ".github" / "workflows").glob("*.yml"))


@pytest.mark.skipif(sys.platform != "linux", reason="the script is tested on Linux")
def test_the_wheel_works_without_a_toolchain():
    script = REPOSITORY / "scripts" / "test-wheel.sh"
    offline = ["--no-index", "--find-links", os.environ["FLAPWING_PACKAGES"]]
    command = [script, os.environ["FLAPWING_WHEEL"], *offline]
    told = subprocess.run(
        command, env={**os.environ, "PYTHON": sys.executable}, capture_output=True, text=True, timeout=300
    )
    assert told.returncode == 0, told.stderr
    assert "the package and the command give the same bytes" in told.stdout
    assert re.search(r"^flap \d+\.\d+\.\d+", told.stdout, re.MULTILINE)


@pytest.mark.skipif(sys.platform != "linux", reason="the script is tested on Linux")
def test_the_archive_of_the_command_works_without_anything_else(tmp_path):
    package = tmp_path / "flap-0.0.0-x86_64-unknown-linux-gnu"
    package.mkdir()
    shutil.copy(os.environ["FLAP"], package / "flap")
    archive = tmp_path / f"{package.name}.tar.gz"
    subprocess.run(["tar", "-czf", archive, "-C", tmp_path, package.name], check=True)
    script = REPOSITORY / "scripts" / "test-archive.sh"
    told = subprocess.run([script, archive], capture_output=True, text=True, timeout=120)
    assert told.returncode == 0, told.stderr
    assert told.stdout.startswith("flap ")
    (package / "flap").write_text("#!/bin/sh\nexit 3\n", encoding="utf-8")
    subprocess.run(["tar", "-czf", archive, "-C", tmp_path, package.name], check=True)
    assert subprocess.run([script, archive], capture_output=True, timeout=120).returncode != 0


def steps(workflow):
    jobs = yaml.safe_load((REPOSITORY / ".github" / "workflows" / workflow).read_text(encoding="utf-8"))["jobs"]
    return {name: [step.get("run") or step.get("with", {}) for step in job["steps"]] for name, job in jobs.items()}


def test_changes_are_tested_with_the_oldest_python_and_as_a_wheel():
    project = (REPOSITORY / "crates" / "flap-py" / "pyproject.toml").read_text(encoding="utf-8")
    oldest = {"python-version": re.search(r'^requires-python = ">=(.*)"$', project, re.MULTILINE).group(1)}
    ci = steps("ci.yml")
    assert oldest in ci["test"] and "./.ci/run ${{ matrix.stages }}" in ci["test"] and oldest in ci["wheel"]
    archive = "./scripts/test-archive.sh dist/*x86_64-unknown-linux-gnu.tar.gz"
    assert {"./scripts/test-wheel.sh dist/*x86_64.whl", archive} <= {
        step for step in ci["wheel"] if isinstance(step, str)
    }


def test_a_release_builds_and_tests_each_target_of_the_script():
    script = (REPOSITORY / "scripts" / "build-wheels.sh").read_text(encoding="utf-8")
    targets = set(re.findall(r"[a-z0-9_]+-(?:unknown|apple|pc)-[a-z0-9-]+", script.split("for triple in")[1]))
    jobs = yaml.safe_load((REPOSITORY / ".github" / "workflows" / "release.yml").read_text(encoding="utf-8"))["jobs"]
    assert {each["target"] for each in jobs["build"]["strategy"]["matrix"]["include"]} == targets
    assert len(targets) == 7
    tests = {step["run"].split()[0]: step.get("if") for step in jobs["build"]["steps"] if "run" in step}
    others = "${{ !endsWith(matrix.target, '-musl') }}"
    assert tests["./scripts/test-wheel.sh"] == tests["./scripts/test-archive.sh"] == others
    assert tests["./scripts/test-musl.sh"] == "${{ endsWith(matrix.target, '-musl') }}"
    assert set(jobs["publish"]["needs"]) == {"build", "source"} and jobs["publish"]["if"] == "github.ref_type == 'tag'"


def test_archives_have_the_names_that_binstall_looks_for(tmp_path):
    with open(REPOSITORY / "crates" / "flap-cli" / "Cargo.toml", "rb") as file:
        wanted = tomllib.load(file)["package"]["metadata"]["binstall"]
    targets = {
        "x86_64-unknown-linux-gnu": wanted,
        "x86_64-pc-windows-msvc": wanted["overrides"]["x86_64-pc-windows-msvc"],
    }
    for target, places in targets.items():
        (folder := tmp_path / f"flap-9.8.7-{target}").mkdir()
        (folder / "flap").write_text("#!/bin/sh\n", encoding="utf-8")
        (folder / "flap").chmod(0o755)
        subprocess.run([sys.executable, REPOSITORY / "scripts" / "archive.py", folder, tmp_path], check=True)
        name = places["pkg-url"].split("/")[-1].replace("{ version }", "9.8.7").replace("{ target }", target)
        first = (tmp_path / name).read_bytes()
        inside = tmp_path / f"unpacked-{target}"
        shutil.unpack_archive(tmp_path / name, inside, "zip" if places["pkg-fmt"] == "zip" else "gztar")
        path = wanted["bin-dir"].replace("{ version }", "9.8.7").replace("{ target }", target)
        assert (inside / path.replace("{ bin }{ binary-ext }", "flap")).is_file()
        (folder / "flap").touch()
        subprocess.run([sys.executable, REPOSITORY / "scripts" / "archive.py", folder, tmp_path], check=True)
        assert (tmp_path / name).read_bytes() == first


@pytest.mark.parametrize("workflow", WORKFLOWS, ids=lambda path: path.name)
def test_workflows_call_scripts_that_exist(workflow):
    jobs = yaml.safe_load(workflow.read_text(encoding="utf-8"))["jobs"]
    commands = [step["run"] for job in jobs.values() for step in job["steps"] if "run" in step]
    assert commands
    for command in commands:
        program = command.split()[0]
        if program.startswith("./"):
            assert os.access(REPOSITORY / program, os.X_OK), command
        else:
            assert command.startswith(
                ("rustup target add ", "mkdir ", "tar ", "target/docs/env/bin/python -m sphinx ")
            ), command


ADDRESS = "https://example.org/owner/flap"
RELEASED = {
    "Cargo.toml": f'[workspace.package]\nversion = "1.2.3"\nrepository = "{ADDRESS}"\n',
    "CITATION.cff": f'version: 1.2.3\nrepository-code: "{ADDRESS}"\ndate-released: 2030-01-31\n',
    "CHANGELOG.md": "# Changelog\n\n## 1.2.3 - 2030-01-31\n\n## 1.2.2 - 2029-12-31\n",
    "docs/how-to/questions.md": "  version = {1.2.3},\n",
    "README.md": "# flap\n",
    "docs/start/install.md": "# Install flap\n",
}


def check_release(folder, *arguments, **replaced):
    """Run the check on the files of a release, after `file: (text, new text)` of `replaced`."""
    for name, text in RELEASED.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text.replace(*replaced.get(name, ("", ""))), encoding="utf-8")
    (folder / "scripts").mkdir(exist_ok=True)
    shutil.copy(REPOSITORY / "scripts" / "check-release.sh", folder / "scripts")
    command = [folder / "scripts" / "check-release.sh", *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=60)


def test_a_release_has_one_version_one_date_and_one_address(tmp_path):
    for arguments in (["1.2.3"], ["1.2.3", ADDRESS]):
        told = check_release(tmp_path, *arguments)
        assert told.returncode == 0 and not told.stderr
    told = check_release(tmp_path, "1.2.3", "https://example.org/other/flap")
    assert told.returncode == 1 and "but this repository is https://example.org/other/flap" in told.stderr
    told = check_release(tmp_path, "1.2.4")
    assert told.returncode == 1 and told.stderr.count("not 1.2.4\n") == 3 and 'not "1.2.4 - YYYY-MM-DD"' in told.stderr


@pytest.mark.parametrize(
    ("file", "text", "new", "message"),
    [
        ("Cargo.toml", "1.2.3", "1.2.2", "Cargo.toml has version 1.2.2, not 1.2.3"),
        ("CITATION.cff", "1.2.3", "1.2.2", "CITATION.cff has version 1.2.2, not 1.2.3"),
        ("docs/how-to/questions.md", "1.2.3", "1.2.2", "docs/how-to/questions.md has version 1.2.2, not 1.2.3"),
        (
            "CHANGELOG.md",
            "1.2.3 - 2030-01-31",
            "1.2.3 (unreleased)",
            'is "1.2.3 (unreleased)", not "1.2.3 - YYYY-MM-DD"',
        ),
        ("CHANGELOG.md", "2030-01-31", "2030-02-01", "CITATION.cff has date-released 2030-01-31, not 2030-02-01"),
        ("CITATION.cff", "date-released: 2030-01-31", "", "CITATION.cff has date-released (none), not 2030-01-31"),
        (
            "CITATION.cff",
            "owner",
            "other",
            "has repository-code https://example.org/other/flap, not https://example.org/owner",
        ),
        ("Cargo.toml", ADDRESS, "", 'repository in Cargo.toml is "": write the address'),
        ("Cargo.toml", ADDRESS, "example.org", 'repository in Cargo.toml is "example.org": write the address'),
        ("Cargo.toml", ADDRESS, f"{ADDRESS}/", f'repository in Cargo.toml is "{ADDRESS}/": write the address'),
        ("README.md", "# flap", "flap has no release yet", "README.md says that flap has no release yet"),
    ],
)
def test_a_mistake_in_a_file_of_a_release_is_reported_alone(tmp_path, file, text, new, message):
    told = check_release(tmp_path, "1.2.3", **{file: (text, new)})
    assert told.returncode == 1 and message in told.stderr and told.stderr.count("check-release: ") == 1, told.stderr


def test_the_files_of_this_repository_have_one_version():
    with open(REPOSITORY / "Cargo.toml", "rb") as file:
        version = tomllib.load(file)["workspace"]["package"]["version"]
    command = [REPOSITORY / "scripts" / "check-release.sh", version]
    assert " has version " not in subprocess.run(command, capture_output=True, text=True, timeout=60).stderr


def test_links_in_the_text_of_a_release_are_addresses(tmp_path):
    (tmp_path / "scripts").mkdir()
    shutil.copy(REPOSITORY / "scripts" / "publish-release.sh", tmp_path / "scripts")
    (tmp_path / "Cargo.toml").write_text(RELEASED["Cargo.toml"], encoding="utf-8")
    section = "[page](docs/page.md#part), [site](https://example.org/a), [support](SUPPORT.md)"
    text = f"## 1.2.4 (unreleased)\n\nnew\n\n## 1.2.3 - 2030-01-31\n\n{section}\n\n## 1.2.2 - 2029-12-31\n\nold\n"
    (tmp_path / "CHANGELOG.md").write_text(text, encoding="utf-8")
    command = [tmp_path / "scripts" / "publish-release.sh", "v1.2.3", "--notes"]
    told = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60).stdout.strip()
    files = f"{ADDRESS}/blob/v1.2.3"
    assert told == f"[page]({files}/docs/page.md#part), [site](https://example.org/a), [support]({files}/SUPPORT.md)"


def test_zenodo_and_the_citation_agree():
    zenodo = json.loads((REPOSITORY / ".zenodo.json").read_text(encoding="utf-8"))
    citation = yaml.safe_load((REPOSITORY / "CITATION.cff").read_text(encoding="utf-8"))
    assert zenodo["title"] == citation["title"] and zenodo["keywords"] == citation["keywords"]
    assert zenodo["creators"] == citation["authors"]
    assert zenodo["description"] == f"<p>{citation['abstract'].strip()}</p>"
    cited = {reference["doi"] for reference in citation["references"] if "doi" in reference}
    assert {each["identifier"] for each in zenodo["related_identifiers"]} == cited
    assert zenodo["upload_type"] == "software"


def test_recipes_get_the_values_of_the_release(tmp_path):
    sdist = tmp_path / "flapwing-0.0.0.tar.gz"
    sdist.write_bytes(b"sources")
    subprocess.run([REPOSITORY / "scripts" / "fill-recipes.sh", sdist, tmp_path], check=True, timeout=60)
    with open(REPOSITORY / "Cargo.toml", "rb") as file:
        version = tomllib.load(file)["workspace"]["package"]["version"]
    with open(REPOSITORY / "crates" / "flap-py" / "pyproject.toml", "rb") as file:
        project = tomllib.load(file)["project"]
    recipe = yaml.safe_load((tmp_path / "recipe.yaml").read_text(encoding="utf-8"))
    assert recipe["context"]["version"] == version
    assert recipe["source"]["sha256"] == hashlib.sha256(b"sources").hexdigest()
    assert [needed.replace(" ", "") for needed in recipe["requirements"]["run"]] == ["python", *project["dependencies"]]
    assert recipe["build"]["skip"] == [f'match(python, "{project["requires-python"].replace(">=", "<")}")']
    formula = (tmp_path / "flap.rb").read_text(encoding="utf-8")
    assert recipe["source"]["sha256"] in formula and f"/v{version}/flapwing-{version}.tar.gz" in formula
    assert not re.search("@[A-Z0-9]+@", formula)
