"""What the programs say of the keys of several files, which together have every key of every kind."""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Described in scenarios.md.
DESCRIBED_WITH_SCENARIOS = ("channel.controller.", "channel.estimator.", "channel.reference_model.")
# Have the keys of another table of the page, which gives their defaults.
LIKE_ANOTHER = re.compile(r"(joint\.antagonist|joint\.antagonist_muscle|bundle\.\d+)\.")
JOINTS = ("muscle", "spring", "gravity")


class Seen:
    """A key as one file has it."""

    def __init__(self, entry, choices):
        self.choices = choices  # which kind and preset its table has there
        self.type = entry["type"]
        self.default = "required" if entry["required"] else entry["default"]
        self.value = entry["value"]
        self.min, self.max = entry.get("min"), entry.get("max")
        self.count = entry.get("min_count"), entry.get("max_count")
        self.names = entry.get("names", [])


def of_file(command, text, name):
    """The keys of a file with this text; its name is a default."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, re.sub(r"\W+", "-", name) + ".toml")
        file.write_text(text)
        done = subprocess.run([*command, file, "--keys", "--json"], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"generate-keys: {name}: {done.stdout}{done.stderr}")
    return json.loads(done.stdout)["keys"]


def add(all_seen, entries):
    choices = {}
    for entry in entries:
        table, _, key = entry["key"].rpartition(".")
        if key in ("kind", "preset"):
            choices.setdefault(table, {})[key] = entry["value"]
    for entry in entries:
        path = re.sub(r"\[\d+\]", "", entry["key"]).replace("every_channel.", "channel.")
        all_seen.setdefault(path, []).append(Seen(entry, choices.get(entry["key"].rpartition(".")[0], {})))


def varied(text):
    """Another lever, less power and one more channel: defaults and ranges depend on them."""
    for old, new in {"0.015": "0.016", "max_W = 4.5": "max_W = 3.0"}.items():
        assert old in text
        text = text.replace(old, new)
    return text + """
[[channel]]
enable.line = "EN"
pwm.number = 100
current.input = "voltage100"
limits.max_travel_m = 0.01
position = { device = "angle", input = "voltage100", m_per_count = 1e-6, min_m = -0.01, max_m = 0.04 }
"""


def boards(programs):
    all_seen = {}
    examples, own = ROOT / "firmware/io/config/examples", ROOT / "toolchain/keys"
    texts = [file.read_text() for folder in (examples, own) for file in sorted(folder.glob("*.toml"))]
    texts.append(varied((own / "together.toml").read_text()))
    for number, text in enumerate(texts):
        add(all_seen, of_file([programs / "supercoild", "--check"], text, f"board-{number}.toml"))
    return {path: seen for path, seen in all_seen.items() if not path.startswith(DESCRIBED_WITH_SCENARIOS)}


def of_scenario(programs, text, name):
    return of_file([programs / "supercoil-sim", "run", "--check"], text, name)


def samples(empty):
    """Scenarios, by what distinguishes them; empty: what is said of the empty one, which names all kinds."""
    names = {entry["key"]: entry.get("names") for entry in empty}
    yield "empty", ""
    yield "slow", "simulation = {duration_s = 100, rate_Hz = 500}\npower.max_W = 0.9\n[[event]]\nat_s = 1\n"
    for key in ("reference.kind", "controller.kind", "estimator.kind", "plant.preset", "controller.preset"):
        for name in names[key]:
            text = f'{key} = "{name}"\n'
            if name == "power":
                text = 'controller.kind = "power"\nreference.kind = "power"\n'
            elif name == "adaptive_ff":
                text += 'estimator.kind = "least_squares"\n'
            yield f"{key} = {name}", text
    yield "poles", "reference_model.poles_rad_per_s = [4, 5, 0.8]\n"
    muscle = "muscle = {stiffness_N_per_m = 20, thermal_mass_J_per_K = 0.2}\nplant.moving_mass_kg = 0.1\n"
    for kinds in ("", 'controller.kind = "pd_ff"\nestimator.kind = "least_squares"\n'):
        yield "muscle", kinds + muscle
    yield "event", "[[event]]\nat_s = 1\n"
    for opposed in JOINTS:
        for kind in names["reference.kind"]:
            if kind != "power":
                yield f"{opposed}, {kind}", f'joint.opposed_by = "{opposed}"\nreference.kind = "{kind}"\n'
    yield "lever", "joint = {lever_m = [0.014, 0.016, 0.014], lever_range_deg = [-40, 40]}\n"
    yield "weak joint", "joint = {}\npower.max_W = 0.9\n"
    yield "bundle", "bundle.muscles = 3\n"


def scenarios(programs):
    all_seen = {}
    for name, text in samples(of_scenario(programs, "", "empty")):
        add(all_seen, of_scenario(programs, text, name))
    return {path: seen for path, seen in all_seen.items() if not LIKE_ANOTHER.match(path)}


def studies(programs):
    """[goals] has a key for each quantity, which --list describes."""
    all_seen = {}
    distributions = ("uniform = [1, 2]", "log_uniform = [1, 2]", "normal = [1, 2]", "list = [1, 2]", "constant = 1")
    texts = ["[study]\n" + "".join(f'[[draw]]\nname = "{line[:3]}"\n{line}\n' for line in distributions),
             '[scenario.simulation]\nduration_s = 300\n[[draw]]\nkeys = "plant.load_N"\nuniform = [0, 1]\n']
    for number, text in enumerate(texts):
        add(all_seen, of_file([programs / "supercoil-sim", "campaign", "--check"], text, f"study-{number}"))
    return {path: seen for path, seen in all_seen.items() if not path.startswith("goals.")}
