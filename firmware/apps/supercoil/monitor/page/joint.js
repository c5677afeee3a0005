// A joint of two muscles, as boards tell of it; and the unit in which set points are typed: lengths, or a joint's angles.

/** The joint of a node's muscle, {lever_m, other}: lever_m < 0 of the antagonist, other is its partner's node. null: it is in none, or
    the board has not told yet. */
export function joint_of(store, node, now_s) {
  const told = {};
  for (const [number, { value }] of store.round(node, "Muscle", "quantity", now_s)) told[store.word("Muscle", "quantity", number)] = value;
  const { joint_lever_m: lever_m, joint_other_node_offset: offset } = told;
  return Math.abs(lever_m) > 0 && Number.isFinite(offset) ? { lever_m, other: node + offset } : null;
}

export const DEGREES = 180 / Math.PI;
/** per_m: of the unit; both_ways: set points may be negative. */
export const LENGTH = { unit: "mm", per_m: 1e3, both_ways: false };
const angle_at = (lever_m) => ({ unit: "°", per_m: DEGREES / lever_m, both_ways: true });

/** In which a node's positions are commanded; joint: of joint_of(). */
export const measure_of = (joint) => (joint && joint.lever_m > 0 ? angle_at(joint.lever_m) : LENGTH);
