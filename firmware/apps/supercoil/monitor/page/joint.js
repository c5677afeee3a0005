// A joint of two muscles, as reported by boards; and the unit in which set points are typed: lengths, or a joint's angles.

export const DEGREES = 180 / Math.PI;
const MAX_POINTS = 7;

/** The lever of a joint by its angle: levers_m at angles evenly spaced from first_rad to last_rad, straight lines between them
    and constant beyond. Alone, a number: constant. */
export class Lever {
  constructor(levers_m, first_rad = 0, last_rad = 0) {
    const step_rad = (last_rad - first_rad) / Math.max(1, levers_m.length - 1);
    let arc_m = 0;
    this.corners = levers_m.map((lever_m, i) => {
      if (i > 0) arc_m += 0.5 * (levers_m[i - 1] + lever_m) * step_rad;
      const slope = i + 1 < levers_m.length ? (levers_m[i + 1] - lever_m) / step_rad : 0;
      return { rad: first_rad + i * step_rad, lever_m, slope, arc_m };
    });
    this.zero_m = this.#from_first(0);
  }

  /** The last corner passed; before the first corner its lever applies. */
  #corner(passed) {
    const [first] = this.corners;
    return this.corners.findLast(passed) ?? { ...first, slope: 0 };
  }

  #from_first(angle_rad) {
    const { rad, lever_m, slope, arc_m } = this.#corner((corner) => corner.rad <= angle_rad);
    const turned = angle_rad - rad;
    return arc_m + (lever_m + 0.5 * slope * turned) * turned;
  }

  /** The lever's integral from the angle 0. */
  arc_m(angle_rad) {
    return this.#from_first(angle_rad) - this.zero_m;
  }

  angle_rad(arc_m) {
    const wanted_m = arc_m + this.zero_m;
    const corner = this.#corner((at) => at.arc_m <= wanted_m), left_m = wanted_m - corner.arc_m;
    return corner.rad + (2 * left_m) / (corner.lever_m + Math.sqrt(corner.lever_m ** 2 + 2 * corner.slope * left_m));
  }
}

/** The lever that the board has reported; constant unless it is a table. */
function lever_of({ joint_lever_m, joint_lever_first_rad: first_rad, joint_lever_last_rad: last_rad, ...muscle }) {
  const levers_m = [];
  for (let i = 1; i <= MAX_POINTS && muscle[`joint_lever_${i}_m`] > 0; ++i) levers_m.push(muscle[`joint_lever_${i}_m`]);
  const is_table = levers_m.length > 1 && first_rad <= 0 && last_rad >= 0 && first_rad < last_rad;
  return is_table ? new Lever(levers_m, first_rad, last_rad) : new Lever([Math.abs(joint_lever_m)]);
}

/** What a board has reported of a node's muscle, by the names of Muscle.quantity. */
function reported_muscle(store, node, now_s) {
  const muscle = {};
  for (const [number, { value }] of store.round(node, "Muscle", "quantity", now_s)) muscle[store.word("Muscle", "quantity", number)] = value;
  return muscle;
}

/** The node that leads the bundle of a node's muscle; null: this node leads, is in no bundle, or the board has not
    reported yet. */
export function leader_of(store, node, now_s) {
  const { bundle_leader_node_offset: offset } = reported_muscle(store, node, now_s);
  return Number.isFinite(offset) ? node + offset : null;
}

/** The joint of a node's muscle, {lever_m, lever, other, other_travel_m}: the lever is this muscle's, lever_m at the
    angle 0, < 0 for the antagonist; other is its partner's node, null if a spring draws it back, and other_travel_m how
    far the partner may contract, if reported, as an arc at this lever. null: it is in no joint, or the board has not
    reported yet. */
export function joint_of(store, node, now_s) {
  const muscle = reported_muscle(store, node, now_s);
  const { joint_lever_m: lever_m, joint_other_node_offset: offset } = muscle;
  if (!(Math.abs(lever_m) > 0) || offset === undefined) return null;
  // Waits for the last value: with half a table, degrees would become wrong metres.
  if (!(`joint_lever_${MAX_POINTS}_m` in muscle)) return null;
  if (!Number.isFinite(offset)) return { lever_m, lever: lever_of(muscle), other: null, other_travel_m: 0 };
  const joint = { lever_m, lever: lever_of(muscle), other: node + offset };
  const others_m = reported_muscle(store, joint.other, now_s).joint_lever_m || lever_m;
  for (const [number, { limit }] of store.round(joint.other, "Limit", "fault", now_s))
    if (store.word("Limit", "fault", number) === "over_travel") joint.other_travel_m = Math.abs(lever_m / others_m) * limit;
  return joint;
}

/** Compares two results of joint_of() by value: the board keeps sending the same joint. */
export const same_joint = (joint, other) => JSON.stringify(joint) === JSON.stringify(other);

/** to_m, of_m: convert from the unit and back; both_ways: set points may be negative; min_m: the minimum, for a muscle with this travel. */
export const LENGTH = { unit: "mm", to_m: (mm) => mm / 1e3, of_m: (m) => m * 1e3, both_ways: false, min_m: () => 0 };
const angle_at = ({ lever, other, other_travel_m }) => ({
  unit: "°",
  to_m: (degrees) => lever.arc_m(degrees / DEGREES),
  of_m: (m) => lever.angle_rad(m) * DEGREES,
  both_ways: other !== null,
  min_m: (max_m) => -(other_travel_m ?? max_m),
});

/** The unit in which a node's positions are commanded; joint: of joint_of(). */
export const measure_of = (joint) => (joint && joint.lever_m > 0 ? angle_at(joint) : LENGTH);
