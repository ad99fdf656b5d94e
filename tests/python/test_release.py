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


def check_release(*arguments):
    return subprocess.run(
        [REPOSITORY / "scripts" / "check-release.sh", *arguments], capture_output=True, text=True, timeout=60
    )


def test_a_tag_must_agree_with_every_file_that_has_the_version():
    told = check_release("99.0.0")
    assert told.returncode == 1
    for file in ("Cargo.toml", "CITATION.cff", "CHANGELOG.md"):
        assert re.search(
            rf"^check-release: {re.escape(file)} has version \S.*, not 99\.0\.0$", told.stderr, re.MULTILINE
        ), file


def test_the_version_of_the_manifest_is_that_of_the_citation():
    manifest = (REPOSITORY / "Cargo.toml").read_text(encoding="utf-8")
    version = re.search(r'^version = "(.*)"$', manifest, re.MULTILINE).group(1)
    told = check_release(version)
    assert "Cargo.toml has version" not in told.stderr and "CITATION.cff" not in told.stderr


def test_a_release_needs_the_address_of_the_repository(tmp_path):
    (tmp_path / "scripts").mkdir()
    shutil.copy(REPOSITORY / "scripts" / "check-release.sh", tmp_path / "scripts")
    (tmp_path / "CITATION.cff").write_text("version: 1.2.3\n", encoding="utf-8")
    (tmp_path / "CHANGELOG.md").write_text("## 1.2.3 - 2030-01-31\n", encoding="utf-8")
    manifest = tmp_path / "Cargo.toml"

    def check(address, *arguments):
        text = f'[workspace.package]\nversion = "1.2.3"\nrepository = "{address}"\n'
        manifest.write_text(text, encoding="utf-8")
        command = [tmp_path / "scripts" / "check-release.sh", "1.2.3", *arguments]
        return subprocess.run(command, capture_output=True, text=True, timeout=60)

    assert check("https://example.org/owner/flap", "https://example.org/owner/flap").returncode == 0
    told = check("https://example.org/owner/flap", "https://example.org/other/flap")
    assert told.returncode == 1 and "but this repository is https://example.org/other/flap" in told.stderr
    for address in ("", "example.org", "https://example.org/owner/flap/"):
        told = check(address)
        assert told.returncode == 1 and f'repository in Cargo.toml is "{address}": write the address' in told.stderr


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
    assert [needed.replace(" ", "") for needed in recipe["requirements"]["run"]] == [
        f"python{project['requires-python']}",
        *project["dependencies"],
    ]
    formula = (tmp_path / "flap.rb").read_text(encoding="utf-8")
    assert recipe["source"]["sha256"] in formula and f"/v{version}/flapwing-{version}.tar.gz" in formula
    assert not re.search("@[A-Z0-9]+@", formula)
