"""What the check of the models and their pictures share."""
import mujoco
import yaml

UNITS = {"rad": 1.0}


def quantity(text):
    """Of "2.1565 rad"."""
    number, unit = text.split()
    return float(number) * UNITS[unit]


def initial_rad(folder):
    """Joint angles at which sim.yaml starts the robot standing, of the legs that are typed: {name: rad}."""
    sim = yaml.safe_load((folder / "sim.yaml").read_text())
    joints = [joint for joint in sim["plant"]["joints"] if "name" in joint]
    out = {joint["name"]: quantity(joint["initial"]) for joint in joints if "initial" in joint}
    mirror = sim.get("mirror", {})
    for image in (mirror.get(key) for key in ("left_right", "front_hind", "both")):
        for joint in joints if image else []:
            name = joint["name"].replace(mirror["leg"] + "_", image + "_", 1)
            sign = -1.0 if joint.get("flips") == "left_right" and image[1] != mirror["leg"][1] else 1.0
            out.setdefault(name, sign * out[joint["name"]])
    return out


def stand(model, data, folder):
    """Puts the robot where sim.yaml starts it, its lowest foot on the floor."""
    for name, angle_rad in initial_rad(folder).items():
        data.qpos[model.joint(name).qposadr[0]] = angle_rad
    mujoco.mj_forward(model, data)
    feet = [i for i in range(model.ngeom) if model.geom(i).name.endswith("_foot")]
    lowest_m = min(data.geom_xpos[i][2] - model.geom_size[i][0] for i in feet)
    height = height_qpos(model)
    if height is not None:
        data.qpos[height] -= lowest_m
    mujoco.mj_forward(model, data)


def height_qpos(model):
    """Where the height of the base is in qpos; None where it is fixed."""
    for i in range(model.njnt):
        if model.jnt_type[i] == mujoco.mjtJoint.mjJNT_FREE:
            return model.jnt_qposadr[i] + 2
        if model.joint(i).name == "rail_z":
            return model.jnt_qposadr[i]
    return None
