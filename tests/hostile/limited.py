"""Runs a command under limits, and says what it took."""

import base64
import os
import resource
import signal
import socket
import subprocess
import threading
import time
from dataclasses import dataclass
from urllib.parse import urlsplit

# Address space [B]: what is never touched counts, too, so this is more than the memory that a command may use.
ADDRESSES = 4 << 30
# Largest file that it may write [B].
FILE = 256 << 20


@dataclass
class Done:
    code: int
    cpu_s: float
    wall_s: float
    memory_mb: float
    out: str
    err: str
    was_killed: bool


def limits(cpu):
    def apply():
        resource.setrlimit(resource.RLIMIT_AS, (ADDRESSES, ADDRESSES))
        resource.setrlimit(resource.RLIMIT_FSIZE, (FILE, FILE))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        # Commands without --threads take as many as there are cores.
        os.sched_setaffinity(0, {cpu})
    return apply


def run(program, words, folder, wall_s, cpu, served=None):
    """Runs it in the folder, for at most `wall_s` seconds; with `served` it serves a page until it is interrupted."""
    out, err = (open(folder / name, "w+b") for name in (".out", ".err"))
    begun = time.monotonic()
    process = subprocess.Popen([program, *words], cwd=folder, stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                               preexec_fn=limits(cpu))
    killed = threading.Event()

    def kill():
        killed.set()
        process.send_signal(signal.SIGKILL)
    timer = threading.Timer(wall_s, kill)
    timer.start()
    if served is not None:
        use(process, folder / ".out", served)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    timer.cancel()
    texts = []
    for file in (out, err):
        file.seek(0)
        texts.append(file.read(200_000).decode("utf-8", "replace"))
        file.close()
    return Done(process.returncode, usage.ru_utime + usage.ru_stime, time.monotonic() - begun, usage.ru_maxrss / 1024,
                *texts, killed.is_set())


def use(process, out, messages):
    """Waits for the address of the page, sends the messages, and interrupts the command."""
    while True:
        ended = os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT)
        address = out.read_text().split("\n")
        if ended or len(address) > 1:
            break
        time.sleep(0.002)
    if not ended:
        if messages:
            try:
                talk(address[0], messages)
            # A page that says too much is cut off.
            except OSError:
                pass
        process.send_signal(signal.SIGINT)


def talk(address, messages):
    """Sends the messages over a WebSocket, each as it is, and reads whatever comes for a moment."""
    at = urlsplit(address)
    with socket.create_connection((at.hostname, at.port), timeout=2) as link:
        key = base64.b64encode(os.urandom(16)).decode()
        asked = [f"GET /live?{at.query} HTTP/1.1", f"Host: {at.netloc}", f"Origin: http://{at.netloc}",
                 "Upgrade: websocket", "Connection: Upgrade", f"Sec-WebSocket-Key: {key}",
                 "Sec-WebSocket-Version: 13", "", ""]
        link.sendall("\r\n".join(asked).encode())
        answer = link.recv(4096)
        if b" 101 " not in answer:
            raise SystemExit(f"{address}: no WebSocket: {answer[:200]}")
        for message in messages:
            link.sendall(frame(message))
        link.settimeout(0.05)
        until = time.monotonic() + 0.3
        while time.monotonic() < until:
            try:
                if not link.recv(1 << 16):
                    break
            except TimeoutError:
                pass


def frame(message):
    """A masked frame of text; its mask is zero, so that the message can be read in it."""
    length = len(message)
    head = bytes([0x81])
    head += bytes([0x80 | length]) if length < 126 else bytes([0x80 | 126]) + length.to_bytes(2, "big")
    return head + bytes(4) + message
