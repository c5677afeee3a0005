# Generated from firmware/io/can/supercoil.dbc by toolchain/generate-can. Do not edit.

"""Names of the values of signals."""

from supercoil.named import Named


class Answers(Named):
    nothing = 0
    knot = 1
    play = 2


class Fault(Named):
    none = 0
    sensor_out_of_range = 10
    sensor_stale = 11
    sensor_frozen = 12
    sensor_jump = 13
    sensors_disagree = 14
    heater_open = 20
    heater_short = 21
    heater_stuck_on = 22
    heater_not_responding = 23
    duty_wrong = 24
    line_failed = 25
    over_temperature = 30
    over_travel = 31
    energy_budget_exceeded = 32
    resistance_drift = 33
    muscle_loose = 34
    under_voltage = 40
    over_voltage = 41
    power_limit_exceeded = 42
    overrun = 50
    tick_late = 51
    telemetry_dead = 52
    command_timeout = 60
    command_damaged = 61
    command_not_allowed = 62
    emergency_stop = 63
    bus_off = 70
    bus_error_passive = 71
    node_conflict = 72
    configuration_invalid = 80
    controller_invalid = 81
    self_test_failed = 82


class Gain(Named):
    none = 0
    proportional = 1
    integral = 2
    derivative = 3
    feedforward = 4
    power_rate = 5
    power = 6
    position_rate = 7
    position_lag = 8
    position = 9
    reference = 10
    sigma = 11
    feedforward_velocity = 12
    feedforward_acceleration = 13
    feedforward_jerk = 14
    bias = 15


class LimitedBy(Named):
    nothing = 0
    minimum = 1
    maximum = 2
    slew = 3
    temperature = 4
    invalid = 5
    cooling = 6
    unproven = 7


class Mode(Named):
    rest = 0
    position = 1
    power = 2
    identify = 3
    calibrate = 4
    joint = 5
    bundle = 6


class Opcode(Named):
    compare = 0
    arm = 1
    disarm = 2
    reset = 3
    position = 4
    power = 5
    renew = 6
    rest = 7
    identify = 8
    calibrate = 9
    scale = 10
    controller = 11
    estimator = 12
    store = 13
    claim_of_version_3 = 14
    lease = 15


class Parameter(Named):
    theta1 = 0
    theta2 = 1
    theta3 = 2
    theta4 = 3
    thermal_mass = 4
    heat_transfer = 5
    stiffness = 6
    damping = 7
    bias = 8
    theta1_deviation = 9
    theta2_deviation = 10
    theta3_deviation = 11
    theta4_deviation = 12
    bias_deviation = 13


class Part(Named):
    motion = 0
    effort = 1
    agonist_heat = 2
    agonist_power = 3
    antagonist_heat = 4
    antagonist_power = 5


class Playback(Named):
    empty = 0
    loaded = 1
    waiting = 2
    playing = 3
    ended = 4
    dry = 5


class Quantity(Named):
    thermal_mass_J_per_K = 0
    heat_transfer_W_per_K = 1
    stiffness_N_per_m = 2
    damping_Ns_per_m = 3
    moving_mass_kg = 4
    force_per_kelvin_N_per_K = 5
    cold_resistance_Ohm = 6
    position_offset_m = 7
    position_scale = 8
    response_ratio = 9
    theta1_deviation_ratio = 10
    theta2_deviation_ratio = 11
    theta3_deviation_ratio = 12
    theta4_deviation_ratio = 13
    unexplained_ratio = 14
    configured_thermal_mass_J_per_K = 15
    configured_heat_transfer_W_per_K = 16
    configured_stiffness_N_per_m = 17
    configured_damping_Ns_per_m = 18
    configured_moving_mass_kg = 19
    configured_force_per_kelvin_N_per_K = 20
    configured_cold_resistance_Ohm = 21
    joint_lever_m = 22
    joint_other_node_offset = 23
    joint_lever_first_rad = 24
    joint_lever_last_rad = 25
    joint_lever_1_m = 26
    joint_lever_2_m = 27
    joint_lever_3_m = 28
    joint_lever_4_m = 29
    joint_lever_5_m = 30
    joint_lever_6_m = 31
    joint_lever_7_m = 32
    bundle_leader_node_offset = 33
    min_set_point_m = 34
    max_set_point_m = 35
    identified_s = 36
    configured_max_W = 37
    configured_trip_C = 38
    configured_min_mass_J_per_K = 39
    configured_max_mass_J_per_K = 40
    configured_min_transfer_W_per_K = 41
    configured_max_transfer_W_per_K = 42
    configured_max_time_constant_s = 43


class Refusal(Named):
    none = 0
    wrong_state = 1
    cause_persists = 2
    no_edge = 3
    not_ready = 4
    busy = 5
    out_of_range = 6
    no_such_channel = 7
    not_lease_holder = 8
    no_lease = 9
    wrong_counter = 10
    queue_full = 11
    claim_again = 12
    protocol_mismatch = 13
    unsuitable = 14
    infeasible = 15


class Result(Named):
    none = 0
    running = 1
    found = 2
    interrupted = 3
    not_cold = 4
    moved = 5
    poor_fit = 6
    uncertain = 7
    implausible = 8
    not_stored = 9
    too_little_motion = 10
    moved_backwards = 11


class Set(Named):
    prepared = 0
    in_use = 1
    configured = 2
    stored = 3


class Setting(Named):
    max_power_W = 0
    measurement_Hz = 1
    tracking_Hz = 2
    power_Hz = 3
    heater_Hz = 4
    temperature_Hz = 5
    estimate_Hz = 6
    margin_Hz = 7
    limit_Hz = 8
    timing_Hz = 9
    status_Hz = 10
    gain_Hz = 11
    supply_gain = 12
    current_gain = 13
    sense_error_ratio = 14


class State(Named):
    disarmed = 0
    armed = 1
    active = 2
    fault = 3


class Tunable(Named):
    kind = 0
    proportional_W_per_m = 1
    integral_W_per_m_s = 2
    derivative_Ws_per_m = 3
    feedforward_W_per_m = 4
    bandwidth_rad_per_s = 5
    derivative_filter_rad_per_s = 6
    follow_s = 7
    forgetting_s = 8
    learn = 9
    period_s = 10
    find_period = 11
    filter_rad_per_s = 12
    regression_rad_per_s = 13
    change_W = 14
    hold_s = 15
    shape_reference = 16
    slow_when_oscillating = 17
    reference_model = 18
    model_pole_1_rad_per_s = 19
    model_pole_2_rad_per_s = 20
    model_pole_3_rad_per_s = 21
    adaptation_scale = 22
    gain_1 = 23
    gain_2 = 24
    gain_3 = 25
    gain_4 = 26
    normalisation = 27
    window_s = 28
    min_ratio = 29
    max_ratio = 30
    max_bias_W = 31
    position_noise_m = 32
    trusted_error = 33
    gain_5 = 34
    gain_6 = 35
    sigma_gain = 36
    damping = 37
    alpha_1 = 38
    alpha_2 = 39
    lambda_1 = 40
    lambda_2 = 41
    p0_rad_per_s = 42
    p1_rad_per_s = 43
    q0_rad_per_s = 44
    freeze_when_limited = 45
    sigma_modification = 46
    dead_zone_W = 47
    adapt_bandwidth = 48
    all = 255


class When(Named):
    at_once = 0
    at_sync = 1
    never = 2
