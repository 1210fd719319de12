"""`python -m bench.studies.gates [PART ...]`: run parts of the study, all of them unless named."""

import os
import sys
import tempfile
import time

from bench.errors import BenchError, UnknownWord
from bench.files import write_json
from bench.provenance import describe
from bench.studies.gates import FOLDER, faults, power, same_code

PARTS = {"faults": faults.run, "power": power.run, "same-code": same_code.run}


def main(words: list[str]) -> int:
    """Run the parts; each writes its file anew after every row."""
    try:
        for word in words or PARTS:
            if word not in PARTS:
                raise UnknownWord("part", word, list(PARTS))
            began, rows = time.time(), []
            for row in PARTS[word]():
                rows.append(row)
                about = {**describe(), "command": f"make regress-study ARGS={word}"}
                about["wall_s"] = round(time.time() - began)
                write_json(FOLDER / f"{word.replace('-', '_')}.json", {"about": about, "rows": rows})
                print(f"{word} {len(rows)}: {str(row)[:200]}", flush=True)
    except BenchError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="orientation-bench-") as cache:
        os.environ.setdefault("NUMBA_CACHE_DIR", cache)  # every planted copy is a state of its own in the shared cache
        sys.exit(main(sys.argv[1:]))
