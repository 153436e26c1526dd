// Geometry of a model's shapes. What moves together and looks alike is one mesh: where pictures are drawn by
// software, each mesh costs as much as some thousand pixels.
import * as THREE from "three";

/** Corners around something round: few where it is thin. */
const around = (radius_m) => (radius_m < 0.025 ? 8 : 14);

function geometry_of(shape, meshes) {
  const [a, b, c] = shape.size_m;
  switch (shape.kind) {
    case "sphere": return new THREE.SphereGeometry(a, 14, 10);
    case "ellipsoid": return new THREE.SphereGeometry(1, 14, 10).scale(a, b, c);
    // three.js has them along y, MuJoCo along z.
    case "capsule": return new THREE.CapsuleGeometry(a, 2 * b, around(a) / 4, around(a)).rotateX(Math.PI / 2);
    case "cylinder": return new THREE.CylinderGeometry(a, a, 2 * b, around(a)).rotateX(Math.PI / 2);
    case "box": return new THREE.BoxGeometry(2 * a, 2 * b, 2 * c);
    case "mesh": {
      const geometry = new THREE.BufferGeometry();
      const mesh = meshes[shape.mesh];
      geometry.setAttribute("position", new THREE.Float32BufferAttribute(mesh.vertices_m, 3));
      geometry.setIndex(mesh.triangles);
      const flat = geometry.toNonIndexed();
      flat.computeVertexNormals();
      return flat;
    }
    default: return null;
  }
}

export function place(object, {position_m, quaternion_wxyz: [w, x, y, z]}) {
  object.position.set(...position_m);
  object.quaternion.set(x, y, z, w);
}

/** Appends a geometry's triangles, placed, of one colour. */
function append(into, geometry, matrix, colour) {
  const first = into.position.length / 3;
  const {position, normal} = geometry.applyMatrix4(matrix).attributes;
  for (const value of position.array) into.position.push(value);
  for (const value of normal.array) into.normal.push(value);
  for (let i = 0; i < position.count; ++i) into.color.push(colour.r, colour.g, colour.b);
  const corners = geometry.index?.array ?? Array.from({length: position.count}, (_, i) => i);
  for (const corner of corners) into.index.push(first + corner);
}

/** All shapes in one geometry, each in its own colour; null where none of them can be drawn. */
export function merged(shapes, meshes) {
  const into = {position: [], normal: [], color: [], index: []};
  const holder = new THREE.Object3D();
  for (const shape of shapes) {
    const geometry = geometry_of(shape, meshes);
    if (geometry === null) continue;
    place(holder, shape);
    holder.updateMatrix();
    const [r, g, b] = shape.rgba;
    append(into, geometry, holder.matrix, new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace));
  }
  if (into.position.length === 0) return null;
  const out = new THREE.BufferGeometry();
  for (const name of ["position", "normal", "color"]) out.setAttribute(name, new THREE.Float32BufferAttribute(into[name], 3));
  out.setIndex(into.index);
  return out;
}
