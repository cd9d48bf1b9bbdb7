"""Runs the tests on a folder that `helixlock gen` wrote: python run.py FOLDER"""

import sys
from pathlib import Path

from cocotb_tools.runner import get_results, get_runner

here = Path(__file__).resolve().parent
folder = Path(sys.argv[1]).resolve()
runner = get_runner("icarus")
runner.build(
    sources=sorted((folder / "rtl").glob("*.v")),
    hdl_toplevel="board_shell",
    build_dir=folder / "build/cocotb",
    timescale=("1ns", "1ps"),
)
results = runner.test(
    hdl_toplevel="board_shell",
    test_module="test_board_shell",
    test_dir=here,
    build_dir=folder / "build/cocotb",
    results_xml=str(folder / "build/cocotb/results.xml"),
)
tests, failed = get_results(results)
sys.exit(0 if tests and not failed else 1)
