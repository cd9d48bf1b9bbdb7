"""Writes the Parquet files beside this script, by pyarrow 26.0.1, pandas 3.1.1 and polars 2.1.0:
the kinds of columns, encodings and compressions people have. Run with `python make.py`."""
import datetime, decimal, os
import pyarrow as pa, pyarrow.parquet as pq, numpy as np, pandas as pd, polars as pl
out = os.path.dirname(os.path.abspath(__file__)) + "/"

n = 7
x = pa.array([0.0, 0.5, 1.0, None, 2.0, 2.5, 3.0], pa.float64())
e = pa.array([-0.25, 0.125, None, 0.5, 1.5, -2.0, 0.0], pa.float32())
steps = pa.array([0, 1, -1, 40, 4095, None, -4095], pa.int32())
count = pa.array([0, 1, 2**40, 3, 4, 5, 2**63 - 1], pa.int64())
big = pa.array([0, 1, 2, 3, 4, 5, 2**64 - 1], pa.uint64())
word = pa.array([0, 1, 2, 3, 4, 5, 2**32 - 1], pa.uint32())
small = pa.array([1, -1, 1, -1, 1, -1, 1], pa.int8())
flag = pa.array([True, False, None, True, False, True, False])
pass_ = pa.array([1, 1, 1, 1, 2, 2, 2], pa.int16()).dictionary_encode()
t = pa.table({"position_mm": x, "error_um": e, "steps": steps, "count": count, "big": big, "word": word, "direction": small, "dwell": flag, "pass": pass_})
for c in ["none", "snappy", "gzip", "zstd", "lz4", "brotli"]:
    pq.write_table(t, f"{out}pyarrow_{c}.parquet", compression=c)
pq.write_table(t, out + "pyarrow_v1_plain.parquet", use_dictionary=False, version="1.0", data_page_version="1.0", row_group_size=3)
pq.write_table(t, out + "pyarrow_v2_delta.parquet", use_dictionary=False, data_page_version="2.0", column_encoding={"position_mm": "BYTE_STREAM_SPLIT", "steps": "DELTA_BINARY_PACKED", "count": "DELTA_BINARY_PACKED"}, row_group_size=2)
df = t.to_pandas(); df.index = pd.Index(range(10, 17)); df.to_parquet(out + "pandas_index.parquet")
pl.from_arrow(t).write_parquet(out + "polars.parquet")
bad = {
 "timestamp": pa.table({"time_s": pa.array([datetime.datetime(2026, 1, 1)] * 2, pa.timestamp("us"))}),
 "date": pa.table({"day": pa.array([datetime.date(2026, 1, 1)] * 2)}),
 "time_of_day": pa.table({"clock": pa.array([datetime.time(1, 2)] * 2)}),
 "list": pa.table({"samples": pa.array([[1.0, 2.0], [3.0]])}),
 "bytes": pa.table({"raw": pa.array([b"a", b"b"])}),
 "half": pa.table({"error_um": pa.array(np.array([1.0, 2.0], np.float16))}),
 "infinite": pa.table({"error_um": pa.array([1.0, float("inf")])}),
 "no_rows": pa.table({"error_um": pa.array([], pa.float64())}),
 "no_columns": pa.table({}),
 "struct": pa.table({"point": pa.array([{"x": "1", "y": 2.0}])}),
}
for k, v in bad.items():
    pq.write_table(v, f"{out}bad_{k}.parquet")
pq.write_table(pa.table({"lead_mm": pa.array([decimal.Decimal("6.000")] * 2)}), out + "decimal.parquet")
pq.write_table(pa.table({"time_s": [1.0, 2.0], "note": ["a", "b"]}), out + "text.parquet")
pq.write_table(pa.table({"time_s": [1.0, 2.0], "note": pa.array(["a", "b"]).dictionary_encode()}), out + "dictionary_text.parquet")
pq.write_table(pa.table({"t": pa.array([datetime.datetime(2026, 1, 1)] * 2, pa.timestamp("ns"))}), out + "bad_int96.parquet", use_deprecated_int96_timestamps=True)
