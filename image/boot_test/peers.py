"""The emulated devices of tests/redir: programs that serve a USB device on a socket."""
import json
import subprocess

from machine import Failed, until


class Peer:
    def __init__(self, program, out, name, *options):
        if not program.exists():
            raise Failed(f"{program} is missing: build its target, {program.name}")
        self.socket = out / f"{name}.sock"
        self.path = out / f"{name}.jsonl"
        for old in (self.socket, self.path):
            old.unlink(missing_ok=True)
        self.process = subprocess.Popen([program, "--socket", self.socket, "--log", self.path, *options],
                                        stdin=subprocess.PIPE, text=True)
        until(f"{name} to listen", 10, self.socket.exists, 0.1)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.stdin.close()
        self.process.terminate()
        self.process.wait()

    def tell(self, line):
        """An order for the device, or for who holds it; fails if it is not understood."""
        before = len(self.events("command"))
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()
        done = until(f"the answer to '{line}'", 10, lambda: self.events("command")[before:], 0.05)
        if done[0]["answer"] != "ok":
            raise Failed(f"{line}: {done[0]['answer']}")

    def events(self, kind=None, since=0.0):
        lines = self.path.read_text().splitlines() if self.path.exists() else []
        found = []
        for line in lines:
            try:
                event = json.loads(line)
            except ValueError:
                continue  # the last, half written
            if (kind is None or event["event"] == kind) and event["unix_s"] >= since:
                found.append(event)
        return found
