"""The samples of an ensemble as a Parquet table, for pandas, Spark and the like."""

from __future__ import annotations

import json
import os
from itertools import islice
from typing import Any

from ..errors import InputError
from ..files.optional import needed
from .ensemble import Ensemble
from .parts import all_lines

_TOGETHER = 2048


def write_parquet(ensemble: Ensemble, path: str | os.PathLike[str]) -> None:
    """Write the samples as a Parquet file: a row a sample, its fields as columns.

    `forces` is a list column; a sample that failed has its error in `failed`. Rows are written some
    thousand at a time. Raises `MissingExtraError` without pyarrow, and `InputError` for an ensemble
    that keeps no samples or a path that cannot be written.
    """
    arrow, parquet = needed("pyarrow", "parquet"), needed("pyarrow.parquet", "parquet")
    if ensemble.folder is None:
        raise InputError("the ensemble", ensemble, "one with a folder that keeps its samples")
    lines = map(json.loads, all_lines(ensemble.folder, ensemble.samples))
    schema: Any = None
    writer: Any = None
    try:
        while some := list(islice(lines, _TOGETHER)):
            if schema is None:
                schema = _schema(arrow, some)
                writer = parquet.ParquetWriter(path, schema)
            writer.write_table(arrow.Table.from_pylist(some, schema=schema))
    except OSError as error:
        raise InputError("the file to write", str(path), f"a writable path ({error})") from error
    finally:
        if writer is not None:
            writer.close()


def _schema(arrow: Any, some: list[dict[str, Any]]) -> Any:
    """The columns of the first rows, and those of rows that failed."""
    found = arrow.Table.from_pylist(some).schema
    for name, kind in (("failed", arrow.string()), ("seed", arrow.int64())):
        if name not in found.names:
            found = found.append(arrow.field(name, kind))
    return found
