// The ground of a simulated run: a net of heights, chequered so that motion over it is seen.
import * as THREE from "three";

const kSquare_m = 0.25;
const kColours = {
  light: {even: 0xdfe4e8, odd: 0xcdd4da, slippery: 0x9cc7ea},
  dark: {even: 0x1d2329, odd: 0x2a323a, slippery: 0x24506f},
};

function slippery(patches, x, y) {
  return patches.some((patch) =>
    x >= patch.from_m && (patch.length_m <= 0 || x < patch.from_m + patch.length_m) &&
    (patch.width_m <= 0 || (y >= patch.right_m && y < patch.right_m + patch.width_m)));
}

/** Two triangles between each four of its points. */
function triangles(columns, lines) {
  const index = [];
  for (let line = 0; line + 1 < lines; ++line)
    for (let column = 0; column + 1 < columns; ++column) {
      const at = line * columns + column;
      index.push(at, at + 1, at + columns, at + 1, at + columns + 1, at + columns);
    }
  return index;
}

export class Ground {
  /** @param ground a scene's `ground` */
  constructor(ground) {
    this.ground = ground;
    const {columns, lines, spacing_m, from_m, heights_mm} = ground;
    const places = new Float32Array(3 * columns * lines);
    heights_mm.forEach((height_mm, i) => {
      places.set([from_m[0] + (i % columns) * spacing_m, from_m[1] + Math.floor(i / columns) * spacing_m,
                  1e-3 * height_mm], 3 * i);
    });
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
    this.geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(places.length), 3));
    this.geometry.setIndex(triangles(columns, lines));
    this.geometry.computeVertexNormals();
    this.mesh = new THREE.Mesh(this.geometry, new THREE.MeshLambertMaterial({vertexColors: true}));
  }

  /** @param theme "light" or "dark" */
  set_theme(theme) {
    const colours = Object.fromEntries(
      Object.entries(kColours[theme]).map(([name, hex]) => [name, new THREE.Color(hex)]));
    const places = this.geometry.getAttribute("position");
    const painted = this.geometry.getAttribute("color");
    for (let i = 0; i < places.count; ++i) {
      const x = places.getX(i), y = places.getY(i);
      const even = (Math.floor(x / kSquare_m) + Math.floor(y / kSquare_m)) % 2 === 0;
      const colour = slippery(this.ground.patches, x, y) ? colours.slippery : even ? colours.even : colours.odd;
      painted.setXYZ(i, colour.r, colour.g, colour.b);
    }
    painted.needsUpdate = true;
  }
}
