"""Every robot's model.xml in the MuJoCo of this interpreter: loads and runs without a warning, can be looked at.

usage: check.py ROBOTS_FOLDER   (see `run` beside this file). Ends with 1 and a line for each thing wrong.
"""
import os
import pathlib
import sys
import tempfile
import warnings

import mujoco

STEPS = 400


def warnings_of(xml_path):
    """Loads and runs it. Returns the model, None where it is refused, and what MuJoCo and Python said."""
    said = []
    mujoco.set_mju_user_warning(said.append)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            model = mujoco.MjModel.from_xml_path(str(xml_path))
            data = mujoco.MjData(model)
            mujoco.mj_step(model, data, STEPS)
        except Exception as refusal:   # whatever a version throws
            return None, [" ".join(str(refusal).split())]
        for i in range(len(data.warning)):
            if data.warning[i].number:
                said.append(f"MuJoCo's warning {mujoco.mjtWarning(i).name} {data.warning[i].number} times")
    said += [str(warning.message) for warning in caught]
    return model, said


def cannot_be_seen(model):
    """What a viewer would miss. Groups 0 to 2 are what viewers show."""
    shown = [i for i in range(model.ngeom) if model.geom_group[i] <= 2]
    seen_bodies = {model.geom_bodyid[i] for i in shown}
    missing = [f"body {model.body(i).name} has no shape" for i in range(1, model.nbody) if i not in seen_bodies]
    missing += [] if model.nlight else ["no light"]
    missing += [] if model.ncam else ["no camera"]
    missing += [f"geom {i} has no material" for i in shown if model.geom_matid[i] < 0]
    for leg in ("fl", "fr", "hl", "hr", "leg"):
        foot = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, leg + "_foot")
        if foot >= 0 and not (foot in shown and model.geom_size[foot][0] >= 0.01):
            missing.append(f"{leg}_foot is no ball that can be seen")
    return missing


def finds_what_is_wrong(robots, folder):
    """The check itself is checked: an attribute that is gone since MuJoCo 3, a plant that diverges."""
    xml = (robots / "pegasus" / "model.xml").read_text()
    gone = xml.replace('iterations="100"', 'iterations="100" collision="predefined"')
    wild = xml.replace('gravity="0 0 -9.81"', 'gravity="0 0 -1e9"')
    wrong = []
    for name, text in (("gone", gone), ("wild", wild)):
        (folder / f"{name}.xml").write_text(text)
        if text == xml or not warnings_of(folder / f"{name}.xml")[1]:
            wrong.append(f"this check does not notice a model of kind '{name}'")
    return wrong


def main():
    robots = pathlib.Path(sys.argv[1]).resolve()
    paths = sorted(robots.glob("*/model.xml"))
    wrong = [] if paths else [f"no model.xml under {robots}"]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)   # where MuJoCo would write its log
        for path in paths:
            model, said = warnings_of(path)
            said += cannot_be_seen(model) if model is not None else []
            log = pathlib.Path("MUJOCO_LOG.TXT")
            said += [f"MUJOCO_LOG.TXT: {log.read_text()}"] if log.exists() else []
            wrong += [f"{path}: {text}" for text in said]
        wrong += finds_what_is_wrong(robots, pathlib.Path(folder))
    for text in wrong:
        print(text)
    print(f"MuJoCo {mujoco.__version__}: {len(paths)} models, {len(wrong)} things wrong")
    sys.exit(1 if wrong else 0)


main()
