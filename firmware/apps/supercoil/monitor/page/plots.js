// The plots of a node.

const MM = 1e3;
const UM = 1e6;
const US = 1e6;
const PERCENT = 100;

const DASH = [6, 4];

export const PLOTS = [
  { title: "Position", unit: "mm", factor: MM, decimals: 3, min_span: 0.2, limit: "over_travel", lines: [
    { message: "Tracking", column: "reference_m", name: "reference", colour: "reference", dash: DASH },
    { message: "Tracking", column: "model_m", name: "model", colour: "model" },
    { message: "Measurement", column: "position_m", name: "position", colour: "position", width: 2 }] },
  { title: "Error", unit: "µm", factor: UM, decimals: 0, min_span: 100, lines: [
    { message: "Tracking", column: "error_m", name: "position less model", colour: "error" }] },
  { title: "Power", unit: "W", factor: 1, decimals: 3, min_span: 0.5, from_zero: true, limit: "power_limit_exceeded",
    mark: { message: "Power", column: "limited" }, lines: [
      { message: "Power", column: "demanded_W", name: "demanded", colour: "reference", dash: DASH },
      { message: "Power", column: "applied_W", name: "applied", colour: "power", width: 2, fill: true }] },
  { title: "Temperature", unit: "°C", factor: 1, decimals: 1, min_span: 20, limit: "over_temperature", show_limit: true,
    band: [0, 1], lines: [
      { message: "Temperature", column: "hottest_C", name: "hottest", colour: "hot" },
      { message: "Temperature", column: "coldest_C", name: "coldest", colour: "cold" }] },
  { title: "Resistance", unit: "Ω", factor: 1, decimals: 3, min_span: 0.2, limit: "resistance_drift", lines: [
    { message: "Measurement", column: "resistance_Ohm", name: "of the muscle", colour: "resistance" }] },
  { title: "Supply", unit: "V", factor: 1, decimals: 3, min_span: 0.5, limit: "over_voltage", lines: [
    { message: "Heater", column: "supply_V", name: "supply", colour: "position" }] },
  { title: "Loop timing", unit: "µs", factor: US, decimals: 1, min_span: 20, from_zero: true, lines: [
    { message: "Timing", column: "late_s", name: "late, at most", colour: "power" },
    { message: "Timing", column: "execution_s", name: "tick, at most", colour: "position" }] },
  { title: "Bus load", unit: "%", factor: PERCENT, decimals: 1, min_span: 10, from_zero: true, lines: [
    { message: "bus", column: "load", name: "of the bus's time", colour: "model", fill: true }] },
];
