// The robot in 3-D. World: x forward, y left, z up, metres; the floor is z = 0.
import * as THREE from "three";
import {OrbitControls} from "orbit_controls";
import {Ground} from "ground";
import {merged, place} from "shapes";
import {PictureClock, Sharpness} from "sharpness";
import {index_of_fields} from "source";

const kForceScale_m_N = 0.0012;  // 400 N are half a metre
const kLeastForce_N = 2;
const kGhostColour = {light: 0x0072b2, dark: 0x56b4e9};  // Okabe and Ito's blues
const kForceColour = 0xd55e00;                           // vermilion: estimated
const kTrueForceColour = 0x009e73;                       // bluish green: the simulation's
const kSlipColour = 0xcc79a7;                            // reddish purple: outside its cone
const kConeHeight_m = 0.16;

/** Colours of torque as a share of its limit, -1 to 1: blue, grey, orange; told apart without red and green. */
const kTorqueStops = [
  [-1.0, [0, 90, 181]], [-0.5, [102, 158, 209]], [0.0, [176, 180, 186]], [0.5, [231, 152, 74]], [1.0, [213, 70, 0]],
];
export function torque_colour(share) {
  const at = Math.max(-1, Math.min(1, share));
  let i = 1;
  while (i < kTorqueStops.length - 1 && kTorqueStops[i][0] < at) ++i;
  const [from, low] = kTorqueStops[i - 1];
  const [to, high] = kTorqueStops[i];
  const part = (at - from) / (to - from);
  return low.map((value, channel) => Math.round(value + part * (high[channel] - value)));
}

// Used over and over: what is made anew for each picture has to be cleared away, which takes time.
const kUp = new THREE.Vector3(0, 1, 0);
const kNoForce = new THREE.Vector3(NaN, NaN, NaN);
const turn_by = new THREE.Quaternion();
const moved_by = new THREE.Vector3();
const foot_at = new THREE.Vector3();
const force_N = new THREE.Vector3();
const true_force_N = new THREE.Vector3();
const base_turn = new THREE.Quaternion();
const base_step = new THREE.Vector3();

/** Most of a picture is floor: its colour as the screen wants it, with nothing to work out for each pixel. */
function floor_material() {
  return new THREE.ShaderMaterial({
    uniforms: {colour: {value: new THREE.Color()}},
    vertexShader: "void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
    fragmentShader: "uniform vec3 colour; void main() { gl_FragColor = vec4(colour, 1.0); }",
  });
}

function take(into, indices, row) {
  const [x, y, z] = indices;
  return into.set(x < 0 ? NaN : row[x], y < 0 ? NaN : row[y], z < 0 ? NaN : row[z]);
}

/** One copy of the robot's bodies, which can be posed. */
class Body {
  /** @param parts_of (body, its index) => [{shapes, material}], one mesh each */
  constructor(scene, parts_of) {
    this.scene = scene;
    this.root = new THREE.Group();
    this.links = scene.bodies.map((body) => {
      const group = new THREE.Group();
      place(group, body);
      group.userData.rest = {position: group.position.clone(), quaternion: group.quaternion.clone()};
      return group;
    });
    scene.bodies.forEach((body, index) => {
      (body.parent < 0 ? this.root : this.links[body.parent]).add(this.links[index]);
      for (const part of parts_of(body, index)) this.add_part(this.links[index], part);
    });
    this.turns = scene.joints.map((joint) => {
      const {axis, position_m, zero} = scene.bodies[joint.body].joint;
      return {link: this.links[joint.body], axis: new THREE.Vector3(...axis), anchor: new THREE.Vector3(...position_m), zero};
    });
    this.base = this.links[scene.base];
  }

  add_part(parent, {shapes, material, on_made}) {
    const geometry = merged(shapes, this.scene.meshes);
    if (geometry === null) return;
    const mesh = new THREE.Mesh(geometry, material);
    parent.add(mesh);
    on_made?.(mesh);
  }

  pose(trunk, angles_rad) {
    if (!this.scene.base_fixed && trunk.every(Number.isFinite)) {
      this.base.position.set(trunk[0], trunk[1], trunk[2]);
      this.base.quaternion.set(trunk[4], trunk[5], trunk[6], trunk[3]);
    }
    this.turns.forEach((turn, i) => {
      if (Number.isFinite(angles_rad[i])) this.turn(turn, angles_rad[i]);
    });
  }

  /** About an axis of the body through an anchor in it, from where it rests. */
  turn({link, axis, anchor, zero}, angle_rad) {
    const {position, quaternion} = link.userData.rest;
    turn_by.setFromAxisAngle(axis, angle_rad - zero);
    link.quaternion.copy(quaternion).multiply(turn_by);
    moved_by.copy(anchor).applyQuaternion(turn_by).sub(anchor).negate();
    link.position.copy(position).add(moved_by.applyQuaternion(quaternion));
  }
}

/** An arrow from a foot that shows a force; the scene's own units. */
class ForceArrow {
  constructor(parent, colour, radius_m) {
    const material = new THREE.MeshBasicMaterial({color: colour});
    this.material = material;
    this.group = new THREE.Group();
    this.shaft = new THREE.Mesh(new THREE.CylinderGeometry(radius_m, radius_m, 1, 8).translate(0, 0.5, 0), material);
    this.head = new THREE.Mesh(new THREE.ConeGeometry(3 * radius_m, 6 * radius_m, 10).translate(0, 3 * radius_m, 0), material);
    this.group.add(this.shaft, this.head);
    parent.add(this.group);
  }
  /** @param force N; used up */
  show(origin, force) {
    const size_N = force.length();
    this.group.visible = Number.isFinite(size_N) && size_N > kLeastForce_N;
    if (!this.group.visible) return;
    const length_m = size_N * kForceScale_m_N;
    this.group.position.copy(origin);
    this.group.quaternion.setFromUnitVectors(kUp, force.divideScalar(size_N));
    this.shaft.scale.y = length_m;
    this.head.position.y = length_m;
  }
}

export class RobotView {
  /**
   * @param scene scene.h's; not null.
   * @throws Error where the browser has no WebGL.
   */
  constructor(canvas, scene, layout) {
    this.canvas = canvas;
    this.scene = scene;
    this.shown = {ghost: true, forces: true, cones: true, torques: true, follow: true};
    // Edges are smoothed by more pixels where there is time for them (sharpness.js).
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: false});
    this.sharpness = new Sharpness();
    this.clock = new PictureClock(this.renderer.getContext());
    this.picture_ms = 0;
    this.renderer.outputColorSpace = THREE.SRGBColorSpace;
    this.three = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(38, 1, 0.02, 80);
    this.camera.up.set(0, 0, 1);
    this.find_fields(layout);
    this.add_light();
    this.add_floor();
    this.add_robot();
    this.add_feet();
    this.dirty = true;
  }

  find_fields(layout) {
    const index = index_of_fields(layout);
    const at = (name) => index.get(name) ?? -1;
    const vector = (name) => ["x", "y", "z"].map((axis) => at(`${name}.${axis}`));
    const {joints, legs} = this.scene;
    this.trunk_fields = ["x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"].map((name) => at(`trunk.${name}`));
    this.angle_fields = joints.map((joint) => at(`joints.${joint.name}.estimated_position_rad`));
    this.ghost_fields = joints.map((joint) => at(`joints.${joint.name}.desired_position_rad`));
    this.torque_fields = joints.map((joint) => at(`joints.${joint.name}.gear_output_torque_Nm`));
    this.leg_fields = legs.map((leg) => ({
      force: vector(`legs.${leg.name}.foot_force_N`),
      true_force: vector(`legs.${leg.name}.true_contact_force_N`),
      contact: at(`legs.${leg.name}.contact`),
      ground: at(`legs.${leg.name}.true_ground_height_m`),
    }));
  }

  add_light() {
    this.hemisphere = new THREE.HemisphereLight(0xffffff, 0x667080, 1.6);
    this.sun = new THREE.DirectionalLight(0xffffff, 1.9);
    this.sun.position.set(1, -1.8, 2.4);
    this.three.add(this.hemisphere, this.sun);
  }

  add_floor() {
    this.grid = new THREE.Group();
    const lines = new THREE.GridHelper(12, 48);
    lines.rotation.x = Math.PI / 2;
    this.lines = lines;
    this.floor = new THREE.Mesh(new THREE.PlaneGeometry(12, 12), floor_material());
    this.floor.position.z = -0.002;
    this.grid.add(this.floor, lines);
    // What lies under each foot: a spot on the floor tells how high the foot is.
    this.three.add(this.grid);
    if (this.scene.ground) {
      this.ground = new Ground(this.scene.ground);
      this.grid.visible = false;
      this.three.add(this.ground.mesh);
    }
    for (const {shapes, material} of this.parts_of(this.scene.world_shapes)) {
      const geometry = merged(shapes, this.scene.meshes);
      if (geometry !== null) this.three.add(new THREE.Mesh(geometry, material));
    }
  }

  /** Shapes that one material can draw: all that cannot be seen through, then each opacity. */
  parts_of(shapes) {
    this.materials ??= new Map();
    const parts = new Map();
    for (const shape of shapes) {
      const alpha = shape.rgba[3];
      if (!parts.has(alpha)) parts.set(alpha, []);
      parts.get(alpha).push(shape);
      if (this.materials.has(alpha)) continue;
      this.materials.set(alpha, new THREE.MeshLambertMaterial({vertexColors: true, transparent: alpha < 1, opacity: alpha}));
    }
    return [...parts].map(([alpha, of_one]) => ({shapes: of_one, material: this.materials.get(alpha)}));
  }

  add_robot() {
    const moved = new Map(this.scene.joints.map((joint, index) => [joint.body, index]));
    this.torque_links = this.scene.joints.map(() => []);
    this.body = new Body(this.scene, (body, index) => {
      const is_foot = ({foot}) => foot !== undefined;
      const rest = this.parts_of(body.shapes.filter((shape) => !is_foot(shape)));
      const coloured = moved.has(index) ? rest.map((part) => this.coloured(part, moved.get(index))) : rest;
      return coloured.concat(this.parts_of(body.shapes.filter(is_foot)));
    });
    this.ghost_material = new THREE.MeshLambertMaterial({transparent: true, opacity: 0.3, depthWrite: false});
    this.ghost = new Body(this.scene, ({shapes}, index) => (index === this.scene.base ? [] : [{shapes, material: this.ghost_material}]));
    this.three.add(this.body.root, this.ghost.root);
  }

  /** A part of a link that a joint moves: in its own colours, or all of it in that of the joint's torque. */
  coloured(part, joint) {
    const {transparent, opacity} = part.material;
    const torque = new THREE.MeshLambertMaterial({transparent, opacity});
    return {...part, on_made: (mesh) => this.torque_links[joint].push({mesh, own: part.material, torque})};
  }

  add_feet() {
    const mu = this.scene.friction_coefficient;
    this.feet = this.scene.legs.map((leg) => {
      if (leg.foot_body === undefined) return null;
      const foot = {leg, place: new THREE.Vector3(...leg.foot_in_body_m), link: this.body.links[leg.foot_body]};
      foot.true_arrow = new ForceArrow(this.three, kTrueForceColour, 0.005);
      foot.arrow = new ForceArrow(this.three, kForceColour, 0.008);
      foot.shadow = new THREE.Mesh(new THREE.CircleGeometry(1.6 * leg.foot_radius_m + 0.012, 16),
                                   new THREE.MeshBasicMaterial({color: 0x000000, transparent: true, opacity: 0.25}));
      this.three.add(foot.shadow);
      if (mu !== null) {
        const cone = new THREE.ConeGeometry(mu * kConeHeight_m, kConeHeight_m, 16, 1, true);
        cone.rotateX(-Math.PI / 2).translate(0, 0, kConeHeight_m / 2);  // its tip at the foot, open upward
        foot.cone = new THREE.Mesh(cone, new THREE.MeshBasicMaterial(
            {transparent: true, opacity: 0.22, side: THREE.DoubleSide, forceSinglePass: true, depthWrite: false}));
        this.three.add(foot.cone);
      }
      return foot;
    });
  }

  /** So that the robot fills the picture, with room to jump; then the camera is the user's. */
  place_camera() {
    const box = new THREE.Box3().setFromObject(this.body.root);
    const size = box.getSize(new THREE.Vector3());
    const away_m = 1.1 * Math.max(0.8, size.length());
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.addEventListener("change", () => { this.dirty = true; });
    this.controls.target.copy(box.getCenter(new THREE.Vector3()));
    this.controls.target.z = Math.max(0.25, 0.5 * box.max.z);
    this.camera.position.copy(this.controls.target).add(new THREE.Vector3(0.85, -1.45, 0.5).multiplyScalar(away_m));
    this.controls.update();
    this.last_base = this.body.base.position.clone();
  }

  /** "light" or "dark" */
  set_theme(theme) {
    const dark = theme === "dark";
    this.three.background = new THREE.Color(dark ? 0x14181d : 0xeef1f4);
    this.floor.material.uniforms.colour.value.set(dark ? 0x1d2329 : 0xdfe4e8).convertLinearToSRGB();
    this.ground?.set_theme(theme);
    this.lines.material.vertexColors = false;
    this.lines.material.color.set(dark ? 0x323b44 : 0xc3cad1);
    this.lines.material.needsUpdate = true;
    this.ghost_material.color.set(kGhostColour[theme]);
    for (const foot of this.feet) foot?.cone?.material.color.set(dark ? 0xf0e442 : 0x8a7500);
    this.dirty = true;
  }

  /** What is drawn: ghost, forces, cones, torques, follow. */
  set_shown(what, on) {
    this.shown[what] = on;
    this.dirty = true;
    if (this.row) this.show(this.row);
  }

  /** Poses everything; draw() brings it to the screen. @param row one number for each field of the layout */
  show(row) {
    this.row = row;
    const numbers = (fields) => fields.map((field) => (field < 0 ? NaN : row[field]));
    const trunk = numbers(this.trunk_fields);
    const angles = numbers(this.angle_fields);
    const wished = numbers(this.ghost_fields);
    this.body.pose(trunk, angles);
    this.ghost.pose(trunk, wished.map((angle, i) => (Number.isFinite(angle) ? angle : angles[i])));
    this.ghost.root.visible = this.shown.ghost && wished.some(Number.isFinite);
    this.colour_torques(numbers(this.torque_fields));
    this.body.root.updateMatrixWorld(true);
    if (!this.controls) this.place_camera();
    this.feet.forEach((foot, i) => { if (foot) this.show_foot(foot, this.leg_fields[i], row); });
    if (this.shown.follow) this.follow();
    this.dirty = true;
  }

  colour_torques(torques_Nm) {
    torques_Nm.forEach((torque_Nm, i) => {
      const limit_Nm = this.scene.joints[i].torque_limit_Nm;
      const known = this.shown.torques && Number.isFinite(torque_Nm) && Boolean(limit_Nm);
      const [r, g, b] = known ? torque_colour(torque_Nm / limit_Nm) : [0, 0, 0];
      for (const {mesh, own, torque} of this.torque_links[i]) {
        mesh.material = known ? torque : own;
        if (known) torque.color.setRGB(r / 255, g / 255, b / 255, THREE.SRGBColorSpace);
      }
    });
  }

  show_foot(foot, fields, row) {
    const origin = foot.link.localToWorld(foot_at.copy(foot.place));
    // Estimated in hip axes, which are the trunk's.
    const force = take(force_N, fields.force, row).applyQuaternion(this.body.base.getWorldQuaternion(base_turn));
    const slips = Math.hypot(force.x, force.y) > (this.scene.friction_coefficient ?? Infinity) * force.z;
    const contact = fields.contact >= 0 && row[fields.contact] > 0.5;
    foot.arrow.show(origin, this.shown.forces && contact ? force : kNoForce);
    foot.true_arrow.show(origin, this.shown.forces ? take(true_force_N, fields.true_force, row) : kNoForce);
    const ground_m = fields.ground >= 0 && Number.isFinite(row[fields.ground]) ? row[fields.ground] : 0;
    foot.shadow.position.set(origin.x, origin.y, ground_m + 0.002);
    const height_m = Math.max(0, origin.z - foot.leg.foot_radius_m - ground_m);
    foot.shadow.material.opacity = 0.35 / (1 + 8 * height_m);
    foot.arrow.material.color.set(slips ? kSlipColour : kForceColour);
    if (foot.cone) {
      foot.cone.visible = this.shown.cones && contact;
      foot.cone.position.set(origin.x, origin.y, origin.z - foot.leg.foot_radius_m);
    }
  }

  /** Camera, light and grid go with the trunk along the floor. */
  follow() {
    const base = this.body.base.position;
    const step = base_step.set(base.x - this.last_base.x, base.y - this.last_base.y, 0);
    this.last_base.copy(base);
    if (step.lengthSq() === 0) return;
    this.camera.position.add(step);
    this.controls.target.add(step);
    this.controls.update();
    const square_m = 0.25;  // of the grid, so that it seems to lie still
    this.grid.position.set(Math.round(base.x / square_m) * square_m, Math.round(base.y / square_m) * square_m, 0);
  }

  /**
   * Draws where something changed, and the picture before is done: none queue up. A picture that stands still is
   * drawn once more, sharp.
   * @return whether it did
   */
  draw() {
    const now_ms = performance.now();
    const took_ms = this.clock.done(now_ms);
    if (took_ms !== null) this.picture_ms = took_ms;
    if (took_ms !== null && !this.was_still) this.sharpness.took(took_ms);
    if (this.clock.busy) return false;
    const {clientWidth: width, clientHeight: height} = this.canvas;
    if (width === 0 || height === 0) return false;
    const still = !this.dirty;
    const ratio = still ? this.sharpness.still_ratio(now_ms - (this.drawn_ms ?? now_ms)) : this.sharpness.ratio;
    const resized = width !== this.width || height !== this.height || (ratio !== this.ratio && (!still || ratio > this.ratio));
    if (!this.dirty && !resized) return false;
    if (resized) this.resize(width, height, ratio);
    this.was_still = still || resized;  // its time says nothing: a new size is paid for once
    this.dirty = false;
    if (!still) this.drawn_ms = now_ms;
    this.clock.begin(now_ms);
    this.renderer.render(this.three, this.camera);
    this.clock.asked();
    return true;
  }

  resize(width, height, ratio) {
    Object.assign(this, {width, height, ratio});
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }
}
