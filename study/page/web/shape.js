// The solids that a link was given to be drawn as, in its frame. Where it is flexible, every corner
// goes with the element of the beam that it lies in.

const kRound = 24;     // edges of a circle
const kMostRows = 64;  // of corners along a solid that bends

// y goes from one place to another, from the middle between them.
function fromTo(from, to) {
  const along = to.clone().sub(from);
  const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0),
    along.clone().normalize());
  return new THREE.Matrix4().compose(from.clone().addScaledVector(along, 0.5), turn,
    new THREE.Vector3(1, 1, 1));
}

const kSolids = {
  cylinder: ({begin, end, diameter}, rows) => {
    const [from, to] = [begin, end].map((place) => new THREE.Vector3(...place));
    return new THREE.CylinderBufferGeometry(diameter / 2, diameter / 2, from.distanceTo(to), kRound,
      rows).applyMatrix(fromTo(from, to));
  },
  box: ({sides, frame}, rows) =>
    new THREE.BoxBufferGeometry(...sides, rows, rows, rows).applyMatrix(frameMatrix(frame)),
  sphere: ({diameter, frame}) =>
    new THREE.SphereBufferGeometry(diameter / 2, kRound, kRound / 2).applyMatrix(frameMatrix(frame)),
};

function solidGeometry(solid, beam) {
  const rows = beam ? Math.min(4 * (beam.borders.length + 1), kMostRows) : 1;
  const geometry = kSolids[solid.kind](solid, rows);
  geometry.computeBoundingBox();
  beam?.bind(geometry);
  return geometry;
}

// Where along a flexible link its elements meet: in the origins of its hinges, whose x is along the
// beam. Unbent, all frames of elements coincide.
class BentBeam {
  constructor(hinges) {
    this.along = new THREE.Vector3().setFromMatrixColumn(frameMatrix(hinges[0].parent_frame), 0);
    this.borders = hinges.map((hinge) => positionOf(hinge.parent_frame).dot(this.along));
  }

  sort(elements, centerOf) {
    const placeOf = (element) => new THREE.Vector3(...centerOf(element)).dot(this.along);
    elements.sort((a, b) => placeOf(a) - placeOf(b));
  }

  // Every corner moves with one element, by its number along the beam.
  bind(geometry) {
    const corners = geometry.attributes.position;
    const [elements, weights] = [[], []];
    for (let i = 0; i < corners.count; ++i) {
      const place = new THREE.Vector3().fromBufferAttribute(corners, i).dot(this.along);
      elements.push(this.borders.filter((border) => border <= place).length, 0, 0, 0);
      weights.push(1, 0, 0, 0);
    }
    geometry.setAttribute("skinIndex", new THREE.Uint16BufferAttribute(elements, 4));
    geometry.setAttribute("skinWeight", new THREE.Float32BufferAttribute(weights, 4));
  }
}

// `groups`: what moves with the elements.
function bentMesh(geometry, material, groups) {
  material.skinning = true;
  const mesh = new THREE.SkinnedMesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.bind(new THREE.Skeleton(groups, groups.map(() => new THREE.Matrix4())), new THREE.Matrix4());
  return mesh;
}
