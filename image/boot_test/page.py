"""docs/reliability.md, from what image/boot-test left in its results.json. A part that was not run anew stays as it was: the parts
take hours, and are run on different days. What was found of them is kept in docs/reliability/results.json."""
import json

HEAD = """# What was done to the box, and how it took it

`image/boot-test` starts the disk image, as it is shipped, on an emulated PC (QEMU, no hardware virtualisation), with an emulated Falcon and
an emulated USB-GPIO bridge plugged in from outside, and does to it what happens to an exhibit. It judges the screen from outside, the
force by what arrives at the Falcon, the lamps by the lines of the bridge. This page is written by the program
(`image/boot-test --page`); it says what the last run of each
part found, also where that is bad.

Times are the emulated machine's. An emulated processor is far slower than a real one, most of all at what a fluid needs, so
the fluid is tiny (8³ cells) and the picture small. A power cut here is one of the machine, not of its disk: what the disk had taken is kept.
A machine that starts again by itself is switched off and on (the emulated PC's firmware sometimes hangs in a warm start). In steps that say *by its own clock* that clock counts instructions, a thousand million a second,
whatever else the computer underneath does; in the others it is the clock on the wall.
"""

PARTS = {"fast": "## Each time (`image/boot-test`)",
         "quick": "## With every change (`image/boot-test --quick`, the part of it that CI takes)",
         "updates": "## Updates (`image/boot-test --updates`)",
         "cuts": "## Power cuts (`image/boot-test --cuts N`)"}


def write_page(docs, results):
    """Returns the files that were written."""
    kept = docs / "reliability" / "results.json"
    everything = json.loads(kept.read_text()) if kept.exists() else {}
    new = json.loads(results.read_text()) if results.exists() else {}
    everything.update({part: found for part, found in new.items() if part in PARTS})
    kept.parent.mkdir(exist_ok=True)
    kept.write_text(json.dumps(everything, indent=1) + "\n")
    (docs / "reliability.md").write_text(page(everything))
    return docs / "reliability.md", kept


def page(everything):
    text = [HEAD]
    for part, title in PARTS.items():
        if part not in everything:
            text.append(f"{title}\n\nNot run yet.\n")
            continue
        found = everything[part]
        good = sum(not step["why"] for step in found["steps"])
        end = "" if found["finished"] else " It did not get to its end."
        text.append(f"{title}\n\n{good} of {len(found['steps'])} steps passed, in {found['minutes']} minutes.{end}\n\n```\n{found['facts']['image']}```\n")
        text.append("| step | passed | took [s] | measured |\n|---|---|---|---|")
        for step in found["steps"]:
            figures = "; ".join(f"{name} {value}" for name, value in step["figures"].items())
            why = step["why"].splitlines()[0].replace("|", "/") if step["why"] else ""
            text.append(f"| {step['name']} | {'**no**: ' + why if why else 'yes'} | {step['seconds']:.0f} | {figures} |")
        text.append("")
    return "\n".join(text)
