"""A sweep in parts on the workers of Dask: python dask_parts.py PARTS [SCHEDULER].

Without a scheduler's address it uses the cores of this machine.
"""

import sys

import cloudpickle
from dask.distributed import Client, as_completed

import parts

# Workers get the functions and what they name, and need no copy of this folder's Python.
cloudpickle.register_pickle_by_value(parts)

if __name__ == "__main__":
    count = int(sys.argv[1])
    with Client(*sys.argv[2:3]) as client:
        numbers = range(1, count + 1)
        tasks = [client.submit(parts.work_out, n, count, pure=False, retries=2) for n in numbers]
        for task in as_completed(tasks):
            print(f"part {task.result()} of {count}")
    print(parts.merge())
