"""Laws as crates of Rust: their own tests, without warnings, and the bits of our kernels."""

import os
import re
import subprocess

import pytest
from support.exported import SHAPES, ask_some, assert_same_bits, needs, written

from bench.export.subject import find_subject
from bench.law.contenders.registry import all_contenders

IN_RUST = ("late-braking", "rotation-matrix", "square-root", "feedback-linearized/quaternion", "joshi-kelkar-wen")
"""Laws without libm but its root, with and without memory, whose bits are compared."""


@needs("cargo")
def test_crates_give_our_bits_without_warnings_and_count_a_wrong_answer(tmp_path):
    """All in one workspace: the laws of SHAPES and IN_RUST, and one whose text is made wrong."""
    crates = [written(find_subject(word), "rust", tmp_path) for word in dict.fromkeys((*SHAPES, *IN_RUST, "gibbs"))]
    wrong = crates[-1] / "src" / "gibbs.rs"
    wrong.write_text(wrong.read_text().replace("2.0 * ", "3.0 * ", 1))
    laws = [find_subject(word) for word in IN_RUST]
    asked = tmp_path / "rust" / "asked"
    (asked / "tests").mkdir(parents=True)
    asks = (f"ask!({one.identifier}{', state' if one.memory else ''});" for one in laws)
    (asked / "tests" / "ask.rs").write_text("\n".join((ask_some(tmp_path, "ask.rs"), *asks)))
    needed = "\n".join(f'{one.identifier} = {{ path = "../{one.identifier}" }}' for one in laws)
    (asked / "Cargo.toml").write_text(f'[package]\nname = "asked"\nedition = "2021"\n[dependencies]\n{needed}\n')
    members = [one.name for one in (*crates, asked)]
    (asked.parent / "Cargo.toml").write_text(f'[workspace]\nresolver = "2"\nmembers = {members}\n')
    fetched = subprocess.run(["cargo", "fetch"], cwd=asked.parent, capture_output=True, text=True)
    if fetched.returncode and "manifest" not in fetched.stderr:
        pytest.skip("cargo cannot fetch libm and nalgebra here (it needs crates.io)")
    words = ["cargo", "test", "--workspace", "--tests", "--no-fail-fast", "--features", "late_braking/nalgebra"]
    env = {**os.environ, "RUSTFLAGS": "-D warnings"}
    ended = subprocess.run(words, cwd=asked.parent, env=env, capture_output=True, text=True)
    assert set(re.findall(r"-p (\w+) --test", ended.stderr)) == {"gibbs"}, ended.stderr
    for contender in (one for one in all_contenders() if one.name in IN_RUST):
        assert_same_bits(tmp_path, contender)
