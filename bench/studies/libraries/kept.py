"""What was answered earlier stays for libraries that are not asked again; what a new version has fixed is marked."""

import pandas as pd

from bench.base.files import read_json, write_json
from bench.experiments.tables.schema import RESULTS
from bench.experiments.tables.store import read, write_table

FOLDER = RESULTS / "libraries"
KEY = ["library", "function", "takes"]


def keep(tables: dict[str, pd.DataFrame], about: dict[str, dict]) -> None:
    """Write the tables and provenance.json, with the rows of libraries that were not asked.

    Args:
        tables: by name, the new rows. about: by library, with what it was asked; restated ones are in no provenance.
    """
    for name, new in tables.items():
        if (FOLDER / f"{name}.parquet").is_file():
            earlier = read(FOLDER, name)
            earlier = earlier.astype(dict.fromkeys(earlier.select_dtypes("category"), str))
            if name == "verdicts":
                new = marked(new, earlier)
            new = pd.concat([earlier[~earlier["library"].isin(new["library"])], new])
        order = new["library"].str.lower()
        new = new.assign(order=order).sort_values("order", kind="stable").drop(columns="order")
        write_table(FOLDER / f"{name}.parquet", new.reset_index(drop=True), name)
        print(f"wrote {name}: {len(new)} rows, {new['library'].nunique()} libraries")
    if (FOLDER / "provenance.json").is_file():
        about = read_json(FOLDER / "provenance.json")["libraries"] | about
    write_json(FOLDER / "provenance.json", {"libraries": about})


def marked(new: pd.DataFrame, earlier: pd.DataFrame) -> pd.DataFrame:
    """New verdicts, each with the faults that an earlier version had and it has no longer, and which version that was.

    What was marked for this version stays marked when it is asked again.
    """
    before = earlier.set_index(KEY)
    rows = []
    for row in new.to_dict("records"):
        place = tuple(row[name] for name in KEY)
        if place in before.index:
            old = before.loc[place]
            if old["version"] == row["version"]:
                row |= {"fixed": old["fixed"], "fixed_since": old["fixed_since"]}
            else:
                gone = sorted(set(words(old["faults"])) - set(words(row["faults"])))
                row |= {"fixed": ", ".join(gone), "fixed_since": old["version"] if gone else ""}
                if gone:
                    print(f"fixed in {row['library']} {row['version']}: {row['function']}: {row['fixed']}")
        rows.append(row)
    return pd.DataFrame(rows)


def words(text: str) -> list[str]:
    """Names between commas."""
    return [one for one in text.split(", ") if one]
