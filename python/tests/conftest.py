"""The examples and the command that the installed wheel is held against."""

import json
import os
import subprocess
from pathlib import Path
from typing import Any, Protocol

import pytest

ROOT = Path(__file__).parents[2]
COMMAND = Path(os.environ.get("HELIXLOCK", ROOT / "target/debug/helixlock"))


class Printed(Protocol):
    """What the command prints with `--json`."""

    def __call__(self, *words: object) -> Any: ...


@pytest.fixture
def example() -> Path:
    """Folder of the examples."""
    return ROOT / "examples"


@pytest.fixture
def printed() -> Printed:
    """Runs the command."""

    def run(*words: object) -> Any:
        texts = [str(word) for word in words]
        done = subprocess.run([COMMAND, *texts, "--json"], capture_output=True, check=False)
        assert done.returncode < 2, done.stderr.decode()
        return json.loads(done.stdout)

    return run
