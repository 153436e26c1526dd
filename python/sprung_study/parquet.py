"""table.parquet: a row a run; units stand in the columns' metadata, seed, plant and command beside."""
import json
from pathlib import Path


def add_arguments(parser):
    parser.add_argument("folder")


def rows_of(folder: Path) -> list[dict]:
    files = sorted((folder / "rows").glob("*.json"), key=lambda file: int(file.stem))
    return [json.loads(file.read_text()) for file in files]


def run(arguments) -> int:
    import pyarrow
    import pyarrow.parquet

    folder = Path(arguments.folder)
    rows = rows_of(folder)
    fields, columns = [], []

    def add(name, kind, values, unit=""):
        fields.append(pyarrow.field(name, kind, metadata={"unit": unit}))
        columns.append(pyarrow.array(values, kind))

    add("run", pyarrow.int64(), [row["run"] for row in rows])
    add("seed", pyarrow.uint64(), [row["seed"] for row in rows])
    add("plant", pyarrow.list_(pyarrow.string()), [row["plant"] for row in rows])
    for name in ("hash", "command", "failure"):
        add(name, pyarrow.string(), [row[name] for row in rows])
    for path in rows[0]["parameters"] if rows else []:
        add(path, pyarrow.float64(), [row["parameters"].get(path) for row in rows])
    values = [{one["name"]: one for one in row["rows"]} for row in rows]
    units = {name: one["unit"] for row in values for name, one in row.items()}
    for name, unit in units.items():
        add(name, pyarrow.float64(), [row[name]["value"] if name in row else None for row in values], unit)
    first = rows[0] if rows else {}
    schema = pyarrow.schema(fields, metadata={key: str(first.get(key, "")) for key in ("study", "version", "files")})
    beside = folder / "table.parquet.part"
    pyarrow.parquet.write_table(pyarrow.Table.from_arrays(columns, schema=schema), beside)
    beside.rename(folder / "table.parquet")
    print("done")
    return 0
