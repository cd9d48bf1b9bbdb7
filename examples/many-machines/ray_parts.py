"""A sweep in parts on the workers of Ray: python ray_parts.py PARTS.

RAY_ADDRESS names a cluster; without it Ray uses the cores of this machine.
"""

import sys

import ray
from ray import cloudpickle

import parts

# Workers get the functions and what they name, and need no copy of this folder's Python.
cloudpickle.register_pickle_by_value(parts)

if __name__ == "__main__":
    count = int(sys.argv[1])
    ray.init()
    work_out = ray.remote(max_retries=2, retry_exceptions=True)(parts.work_out)
    for done in ray.get([work_out.remote(number, count) for number in range(1, count + 1)]):
        print(f"part {done} of {count}")
    print(parts.merge())
