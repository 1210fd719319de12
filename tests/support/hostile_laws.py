"""Laws that misbehave: name -> the text of a file, which is sound but for some lines, and what must become of it."""

import psutil

from bench.law.contenders.law_process import TOKEN
from support.user_law import law_text, spring_text

WAITS, LOOPS, MISREAD = "it did not return", "it did not return within 1 s", "its process did not say what it is"
ENDED = "it ended its process"
WRITTEN = """
def written(said):
    for line in range(3, 64):
        try: os.write(line, said)
        except OSError: pass"""


IMPORTS = "import atexit, os, resource, shutil, signal, sys, threading, time"


def top(*lines: str) -> str:
    """A sound law with these lines at the top of its file."""
    return "\n".join((IMPORTS, *lines)) + spring_text(name="NAME")


def each(*lines: str) -> str:
    """A law that does this whenever it is called."""
    return spring_text("k = 0.0", *lines, name="NAME")


def some(line: str) -> str:
    """A law that does this in some states."""
    return each("if R.n[0] < -0.1:", f"    {line}")


def late(line: str) -> str:
    """A file that does this when it is imported in a run, and not when it is first read."""
    return top(f"if 'sandbox' in sys.argv[0]: {line}")


AT_IMPORT: dict[str, tuple[str | bytes | None, str]] = {
    "sleeps": (top("time.sleep(1000)"), WAITS),
    "stops-itself": (top("os.kill(os.getpid(), signal.SIGSTOP)"), WAITS),
    "halts-in-a-message": (top("os.write(int(sys.argv[1]), bytes([0, 0, 0, 9, 65]))", "time.sleep(1000)"), WAITS),
    "ignores-its-limit": (top("signal.signal(signal.SIGXCPU, signal.SIG_IGN)", "while True: pass"), WAITS),
    "lifts-its-limit": (top("resource.setrlimit(resource.RLIMIT_CPU, (-1, -1))", "while True: pass"), WAITS),
    "loops": (top("while True: pass"), LOOPS),
    "loops-deaf-to-signals": (top("for k in (2, 15): signal.signal(k, signal.SIG_IGN)", "while True: pass"), LOOPS),
    "endless-generator": (top("sum(iter(int, 1))"), LOOPS),
    "catastrophic-expression": (top("import re", "re.match('(a+)+$', 'a' * 99 + 'b')"), LOOPS),
    "exits-at-once": (top("os._exit(0)"), f"{ENDED}, exit code 0"),
    "becomes-another": (top("os.execv(sys.executable, [sys.executable, '-V'])"), f"{ENDED}, exit code 0"),
    "exits": (top("sys.exit(3)"), "does not import (SystemExit in line 2: 3)"),
    "interrupts": (top("raise KeyboardInterrupt"), ENDED),
    "segfault": (top("import ctypes", "ctypes.string_at(0)"), f"{ENDED}, SIGSEGV"),
    "aborts": (top("os.abort()"), f"{ENDED}, SIGABRT"),
    "kills-itself": (top("os.kill(os.getpid(), 9)"), f"{ENDED}, SIGKILL"),
    "kills-its-parent": (top("os.kill(os.getppid(), 9)", "time.sleep(9)"), f"{ENDED}, SIGKILL"),
    "kills-its-group": (top("os.killpg(0, 15)"), f"{ENDED}, SIGTERM"),
    "closes-all": (top("os.closerange(0, 256)"), ENDED),
    "gigabytes": (top("a = bytearray(64 << 30)"), "MemoryError in line 2"),
    "little-by-little": (top("a = []", "while 1: a.append(bytes(1 << 28))"), "MemoryError in line 3"),
    "recursion": (top("f = lambda: f()", "f()"), "RecursionError in line 2"),
    "rubbish-on-the-line": (top(WRITTEN, "written(b'rubbish')"), ENDED),
    "forges-an-answer": (top(WRITTEN, r"written(b'\0\0\0\2{}')"), MISREAD),
    "forges-fields": (top(WRITTEN, """written(b'\\0\\0\\0\\x1d{"fields": {"functions": []}}')"""), MISREAD),
    "without-built-ins": (top("import builtins", "builtins.isinstance = None"), ENDED),
    "asks-for-input": (top("input()"), "EOFError in line 2"),
    "not-utf-8": (top("# caf\xe9").encode("latin-1"), "it is not UTF-8"),
    "nul": (b"x = 1\0", "does not import (SyntaxError"),
    "folder": (None, "there is no such file"),
    "empty": ("", "it has no REGULATOR"),
    "is-a-generator": (law_text("yield omega", name="NAME"), "returned <generator object"),
}
"""Refused, with the reason in one line."""

NOISY = (
    "for k in range(100000): print('x' * 100)",
    "threading.Thread(target=time.sleep, args=(1000,)).start()",
    "atexit.register(time.sleep, 1000)",
    "os.chdir('/')",
    "shutil.rmtree(os.environ['TMPDIR'])",
    "for k in range(2):",
    "    if not os.fork():",
    "        os.setsid()",
    "        time.sleep(1000)",
)
"""What a law may do and have its rows all the same."""

COMPILED = {
    "always-raises": (each("raise ValueError('no')"), "crashed"),
    "always-exits": (each("os._exit(0)"), "crashed"),
    "always-leaves": (each("sys.exit(3)"), "crashed"),
    "always-loops": (each("while x == x: k += 1.0"), "hung"),
    "without-end": (each("while True: pass"), "hung"),
    "always-sleeps": (each("time.sleep(1000)"), "hung"),
    "calls-itself": (each("x = law(R, omega, goal, gains)[0]"), "crashed"),
    "late-exit": (late("os._exit(0)"), "crashed"),
    "late-leave": (late("raise KeyboardInterrupt"), "crashed"),
    "late-fratricide": (late("os.kill(os.getppid(), 9); time.sleep(9)"), "crashed"),
    "late-silence": (late("os.closerange(0, 256)"), "crashed"),
    "late-rubbish": (late("os.write(int(sys.argv[1]), bytes([0, 0, 0, 1, 65]))"), "crashed"),
    "raises": (some("raise ValueError('no')"), "crashed"),
    "loops": (some("while x == x: k += 1.0"), "hung"),
    "nan": (some("x = math.nan"), "singular"),
    "infinite": (some("x = 1.0 / (k * x)"), "singular"),
    "noisy": (top(*NOISY), ""),
    "changes-the-judge": (top("import tasks.verdict", "tasks.verdict.OUTCOMES = ()"), "crashed"),
}
"""Run on the engine ideal-rk4: what becomes of all episodes, or of some; "" of a law that runs as a sound one."""

IN_A_TICK = {
    "exits": ("os._exit(0)", "crashed"),
    "leaves": ("sys.exit(3)", "crashed"),
    "interrupts": ("(_ for _ in ()).throw(KeyboardInterrupt)", "crashed"),
    "segfault": ("ctypes.string_at(0)", "crashed"),
    "two-numbers": ("(1.0, 2.0)", "crashed"),
    "words": ("('a', 'b', 'c')", "crashed"),
    "nothing": ("None", "crashed"),
    "an-object": ("object()", "crashed"),
    "nan": ("(math.nan, 0.0, 0.0)", "singular"),
    "infinite": ("(math.inf, 0.0, 0.0)", "singular"),
    "calls-itself": ("law(R, omega, goal, gains)", "crashed"),
    "gigabytes": ("bytearray(64 << 30)", "crashed"),
    "no-memory": ("resource.setrlimit(resource.RLIMIT_DATA, (1, 1)) or bytes(1 << 28)", "crashed"),
    "kills-its-parent": ("os.kill(os.getppid(), 9) or time.sleep(9)", "crashed"),
    "kills-its-group": ("os.killpg(0, 9)", "crashed"),
    "closes-all": ("os.closerange(0, 256)", "crashed"),
    "rubbish-on-the-line": ("written(b'rubbish')", "crashed"),
    "forges-an-answer": (r"written(b'+\n') or os._exit(0)", "crashed"),
    "endless-generator": ("sum(iter(int, 1))", "hung"),
    "deaf-to-signals": ("[signal.signal(k, 1) for k in (2, 15, 24)] and sum(iter(int, 1))", "hung"),
    "stops-itself": ("os.kill(os.getpid(), signal.SIGSTOP)", "hung"),
    "prints": ("print('x' * 10**6) or u", ""),
    "forks": ("u if os.fork() else time.sleep(1000)", ""),
    "breaks-away": ("u if os.fork() else os.setsid() or time.sleep(1000)", ""),
    "thread": ("threading.Thread(target=time.sleep, args=(1000,)).start() or u", ""),
    "at-exit": ("atexit.register(time.sleep, 1000) and u", ""),
    "elsewhere": ("os.chdir('/') or os.nice(9) and u", ""),
}
"""The same, in Python: what a law answers in the first tick of an episode, one after the other."""

IN_TURN = """
import atexit, ctypes, resource, signal, threading
{WRITTEN}
BEGINNINGS, ANSWERS = {beginnings}, [{answers}]
"""


def in_turn(beginnings: list[float]) -> str:
    """A law that answers so in episodes that begin with these R.n[0], and else is sound."""
    answers = ", ".join(f"lambda R, omega, goal, gains, u: {one}" for one, _ in IN_A_TICK.values())
    head = IN_TURN.format(WRITTEN=WRITTEN, beginnings=beginnings, answers=answers)
    first = "if R.n[0] in BEGINNINGS: return ANSWERS[BEGINNINGS.index(R.n[0])](R, omega, goal, gains, (-x, -y, -z))"
    return head + spring_text(first, name="NAME")


def left_behind(marker: str) -> list[psutil.Process]:
    """Processes of laws that run still, of those that have this in their environment."""
    found = []
    for process in psutil.process_iter():
        try:
            if {TOKEN, marker} <= process.environ().keys() and process.status() != psutil.STATUS_ZOMBIE:
                found.append(process)
        except psutil.Error:
            continue
    return found
