"""A process that answers requests of tests/running/test_isolated.py, most of them badly."""

import json
import os
import signal
import subprocess
import sys
import time

from bench.base.errors import BadNumber
from bench.base.isolated import Line
from bench.base.serving import send_progress, serve


def use_processor() -> None:
    """Use 0.6 s of processor time."""
    ends = time.process_time() + 0.6
    while time.process_time() < ends:
        pass


def misbehave(request: dict, line: Line) -> bytes:
    """Do what the request says, and answer."""
    deed = request["deed"]
    if deed == "raises":
        raise ValueError("no")
    if deed == "refuses":
        raise BadNumber("kp 0 is no gain")
    if deed == "exits":
        os._exit(3)
    if deed == "leaves":
        sys.exit(3)
    if deed == "kills itself":
        os.kill(os.getpid(), signal.SIGKILL)
    if deed == "loops":
        # Deaf to the first signal of its limit, which ends a process that does not listen.
        if request["in_fork"]:
            signal.signal(signal.SIGXCPU, signal.SIG_IGN)
        while True:
            pass
    if deed == "sleeps":
        time.sleep(1000)
    if deed == "eats memory":
        return bytes(5 << 30)
    if deed == "writes rubbish":
        os.write(int(sys.argv[1]), b"rubbish")
    if deed == "halts in a message":
        os.write(int(sys.argv[1]), b"\0\0\0\x09A")
        time.sleep(1000)
    if deed == "starts another":
        process = subprocess.Popen(["sleep", "1000"], start_new_session=True)
        return str(process.pid).encode()
    if deed == "makes forks dear":
        os.register_at_fork(before=use_processor)
    if deed == "makes progress":
        for number in (1, 2, 3):
            send_progress(line, number)
    print("this goes nowhere")
    return json.dumps(request["deed"]).encode()


if __name__ == "__main__":
    serve(misbehave)
