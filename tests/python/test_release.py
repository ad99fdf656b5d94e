"""The scripts and workflows of releases."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

REPOSITORY = Path(__file__).parents[2]
WORKFLOWS = sorted((REPOSITORY / ".github" / "workflows").glob("*.yml"))


@pytest.mark.skipif(sys.platform != "linux", reason="wheels of releases are for Linux")
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


@pytest.mark.skipif(sys.platform != "linux", reason="archives of releases are for Linux")
def test_the_archive_of_the_command_works_without_anything_else(tmp_path):
    package = tmp_path / "flap-0.0.0-x86_64-linux"
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
    tested = ["./scripts/test-wheel.sh dist/*x86_64.whl", "./scripts/test-archive.sh dist/*x86_64-linux.tar.gz"]
    assert set(tested) <= {step for step in ci["wheel"] if isinstance(step, str)}
    release = steps("release.yml")
    for step in tested:
        assert step in release["build"] and step.replace("x86_64", "aarch64") in release["test-aarch64"]


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


def check_version(version):
    return subprocess.run(
        [REPOSITORY / "scripts" / "check-version.sh", version], capture_output=True, text=True, timeout=60
    )


def test_a_tag_must_agree_with_every_file_that_has_the_version():
    told = check_version("99.0.0")
    assert told.returncode == 1
    for file in ("Cargo.toml", "CITATION.cff", "CHANGELOG.md"):
        assert re.search(
            rf"^check-version: {re.escape(file)} has version \S.*, not 99\.0\.0$", told.stderr, re.MULTILINE
        ), file


def test_the_version_of_the_manifest_is_that_of_the_citation():
    manifest = (REPOSITORY / "Cargo.toml").read_text(encoding="utf-8")
    version = re.search(r'^version = "(.*)"$', manifest, re.MULTILINE).group(1)
    told = check_version(version)
    assert "Cargo.toml" not in told.stderr and "CITATION.cff" not in told.stderr
