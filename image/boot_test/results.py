"""What the steps found: a line each, and a file from which docs/reliability.md is written."""
import contextlib
import json
import time

from machine import Failed


class Stop(Exception):
    """A step failed that the others stand on."""


class Step:
    def __init__(self, name):
        self.name, self.figures, self.why, self.too_much = name, {}, None, None

    def figure(self, name, value, most=None):
        """What was measured; more than `most` fails the step, once it has ended."""
        self.figures[name] = value
        if most is not None and value > most:
            self.too_much = self.too_much or f"{name} {value}: at most {most} is allowed"


class Results:
    def __init__(self, path, part, facts):
        """What was found of this part before is forgotten with its first step."""
        self.path, self.part, self.facts = path, part, facts
        self.steps = []
        self.began = time.monotonic()

    @contextlib.contextmanager
    def step(self, name, fatal=False):
        step = Step(name)
        begin = time.monotonic()
        try:
            yield step
            step.why = step.too_much
        except Exception as error:
            step.why = str(error) if isinstance(error, Failed) else f"{type(error).__name__}: {error}"
        step.seconds = round(time.monotonic() - begin, 1)
        self.steps.append(step)
        figures = "".join(f"; {name} {value}" for name, value in step.figures.items())
        print(f"{'FAIL' if step.why else 'PASS'} {step.seconds:6.1f} s  {step.name}{figures}", flush=True)
        if step.why:
            print("     " + step.why.replace("\n", "\n     "), flush=True)
        self.save()
        if step.why and fatal:
            raise Stop(step.name)

    def count(self):
        """How many steps passed, of how many."""
        return sum(not s.why for s in self.steps), len(self.steps)

    def finish(self):
        self.save(finished=True)

    def save(self, finished=False):
        everything = json.loads(self.path.read_text()) if self.path.exists() else {}
        everything[self.part] = {"facts": self.facts, "finished": finished, "minutes": round((time.monotonic() - self.began) / 60, 1),
                                 "steps": [{"name": s.name, "seconds": s.seconds, "figures": s.figures, "why": s.why}
                                           for s in self.steps]}
        self.path.write_text(json.dumps(everything, indent=1) + "\n")
