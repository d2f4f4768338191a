"""What the steps found: a line each, and a file from which docs/reliability.md is written."""
import contextlib
import json
import time

from machine import Failed


class Stop(Exception):
    """A step failed that the others stand on."""


class Step:
    def __init__(self, name):
        self.name, self.figures, self.why = name, {}, None

    def figure(self, name, value):
        self.figures[name] = value


class Results:
    def __init__(self, path):
        self.path = path
        self.steps = []
        self.began = time.monotonic()

    @contextlib.contextmanager
    def step(self, name, fatal=False):
        step = Step(name)
        begin = time.monotonic()
        try:
            yield step
        except (Failed, OSError, ValueError, KeyError) as error:
            step.why = f"{type(error).__name__}: {error}" if not isinstance(error, Failed) else str(error)
        step.seconds = round(time.monotonic() - begin, 1)
        self.steps.append(step)
        figures = "".join(f"; {name} {value}" for name, value in step.figures.items())
        print(f"{'FAIL' if step.why else 'PASS'} {step.seconds:6.1f} s  {step.name}{figures}", flush=True)
        if step.why:
            print("     " + step.why.replace("\n", "\n     "), flush=True)
            if fatal:
                raise Stop(step.name)

    def failed(self):
        return [s for s in self.steps if s.why]

    def save(self, part, facts):
        everything = json.loads(self.path.read_text()) if self.path.exists() else {}
        everything[part] = {"facts": facts, "minutes": round((time.monotonic() - self.began) / 60, 1),
                            "steps": [{"name": s.name, "seconds": s.seconds, "figures": s.figures, "why": s.why}
                                      for s in self.steps]}
        self.path.write_text(json.dumps(everything, indent=1) + "\n")
