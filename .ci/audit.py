"""Known vulnerabilities of what the locks name, by pip-audit.

    .venv-audit/bin/python .ci/audit.py requirements/*.txt      (make audit)

Exit code 0: every lock was looked at, and has none. 1: there is one. 2: a lock could not be looked at.

Names and versions are sent to the index that pip asks; nothing is installed. An index that lists no vulnerabilities
says so of every package, which is not the same as having none.
"""

import json
import subprocess
import sys

AUDIT = ("-m", "pip_audit", "--format", "json", "--progress-spinner", "off", "--disable-pip", "--no-deps")


def audit(lock: str) -> list[dict] | str:
    """What is known of each package of a lock, or in a line why nothing could be asked."""
    asked = subprocess.run([sys.executable, *AUDIT, "-r", lock], capture_output=True, text=True)
    try:
        return json.loads(asked.stdout)["dependencies"]
    except (ValueError, KeyError):
        said = [line for line in asked.stderr.splitlines() if line.strip()]
        return said[-1] if said else f"pip-audit ended with {asked.returncode}"


def main(locks: list[str]) -> int:
    """Audit every lock, print a line for each and for each vulnerability; the exit code."""
    found, unseen = 0, []
    for lock in locks:
        known = audit(lock)
        if isinstance(known, str):
            print(f"{lock}: not audited, no answer ({known})")
            unseen.append(lock)
            continue
        answered = [one for one in known if "skip_reason" not in one]
        flaws = [(one, flaw) for one in answered for flaw in one["vulns"]]
        found += len(flaws)
        for one, flaw in flaws:
            cure = f"fixed in {', '.join(flaw['fix_versions'])}" if flaw["fix_versions"] else "no fixed version yet"
            print(f"{lock}: {one['name']} {one['version']} has {flaw['id']}, {cure}")
        if answered:
            print(f"{lock}: {len(answered)} of {len(known)} packages audited, {len(flaws)} known vulnerabilities")
        else:
            unseen.append(lock)
            print(f"{lock}: not audited, the index knows nothing of vulnerabilities ({len(known)} packages)")
    if unseen:
        print(f"{len(unseen)} of {len(locks)} locks were not audited; run this where pypi.org answers")
    return 1 if found else 2 if unseen else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
