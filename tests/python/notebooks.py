"""Executes a notebook and stores it with its outputs, without execution counts, times and versions:

python tests/python/notebooks.py docs/start/first-notebook.ipynb
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import nbformat

# Runs the notebook with sockets in the folder in place of ports. It is a separate process because nbclient leaves sockets
# open, and Python warns when they are collected.
RUN = """
import sys
import nbclient
import nbformat
from jupyter_client.manager import AsyncKernelManager

notebook, folder, executed = sys.argv[1:]
kernel = AsyncKernelManager(kernel_name="python3", transport="ipc", ip=f"{folder}/ipc")
cells = nbformat.read(notebook, as_version=4)
nbclient.NotebookClient(cells, km=kernel, timeout=120, resources={"metadata": {"path": folder}}).execute()
nbformat.write(cells, executed)
"""


def executed(notebook: Path) -> nbformat.NotebookNode:
    """The notebook with the outputs of its code."""
    # The names of sockets must be short. Nothing is written to the user's home, and the kernel chooses how pictures are
    # shown.
    with tempfile.TemporaryDirectory(prefix="nb") as folder:
        environment = {**os.environ, "JUPYTER_RUNTIME_DIR": folder, "IPYTHONDIR": folder, "JUPYTER_NO_CONFIG": "1"}
        environment.pop("MPLBACKEND", None)
        result = Path(folder) / "executed.ipynb"
        command = [sys.executable, "-c", RUN, notebook, folder, result]
        ended = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=300)
        assert ended.returncode == 0, ended.stderr
        return stripped(nbformat.read(result, as_version=4))


def stripped(notebook: nbformat.NotebookNode) -> nbformat.NotebookNode:
    """The notebook without the parts that differ between two executions."""
    notebook.metadata.language_info = {"name": "python"}
    for cell in notebook.cells:
        cell.metadata = {}
        if cell.cell_type == "code":
            cell.execution_count = None
            for output in cell.outputs:
                if "metadata" in output:
                    output.metadata = {}
                if "execution_count" in output:
                    output.execution_count = None
    return notebook


def written(notebook: nbformat.NotebookNode) -> str:
    """The text of the file."""
    return nbformat.writes(notebook, indent=1) + "\n"


if __name__ == "__main__":
    path = Path(sys.argv[1])
    path.write_text(written(executed(path)), encoding="utf-8")
