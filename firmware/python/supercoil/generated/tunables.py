# Generated from docs/tuning.md by toolchain/generate-can. Do not edit.

"""What the values of controllers and estimators may be."""

from supercoil.generated.names import Tunable

CONTROLLER_UNITS = {
    Tunable.kind: "",
    Tunable.proportional_W_per_m: "W/m",
    Tunable.integral_W_per_m_s: "W/(m s)",
    Tunable.derivative_Ws_per_m: "W s/m",
    Tunable.feedforward_W_per_m: "W/m",
    Tunable.bandwidth_rad_per_s: "rad/s",
    Tunable.derivative_filter_rad_per_s: "rad/s",
    Tunable.follow_s: "s",
    Tunable.forgetting_s: "s",
    Tunable.learn: "",
    Tunable.period_s: "s",
    Tunable.find_period: "",
    Tunable.filter_rad_per_s: "rad/s",
    Tunable.regression_rad_per_s: "rad/s",
    Tunable.change_W: "W",
    Tunable.hold_s: "s",
    Tunable.shape_reference: "",
    Tunable.slow_when_oscillating: "",
    Tunable.reference_model: "",
    Tunable.model_pole_1_rad_per_s: "rad/s",
    Tunable.model_pole_2_rad_per_s: "rad/s",
    Tunable.model_pole_3_rad_per_s: "rad/s",
    Tunable.adaptation_scale: "",
}

# A value is sent as its place among them.
CONTROLLER_CHOICES = {
    Tunable.kind: ("power", "pi", "pd_ff", "mrac", "mrac_ls", "adaptive_ff", "learned_ff"),
    Tunable.learn: ("false", "true"),
    Tunable.find_period: ("false", "true"),
    Tunable.shape_reference: ("false", "true"),
    Tunable.slow_when_oscillating: ("false", "true"),
    Tunable.reference_model: ("poles", "design", "eq8", "wm16"),
}

ESTIMATOR_UNITS = {
    Tunable.kind: "",
    Tunable.forgetting_s: "s",
    Tunable.gain_1: "",
    Tunable.gain_2: "",
    Tunable.gain_3: "",
    Tunable.gain_4: "",
    Tunable.normalisation: "",
    Tunable.window_s: "s",
    Tunable.min_ratio: "",
    Tunable.max_ratio: "",
    Tunable.max_bias_W: "W",
    Tunable.position_noise_m: "m",
    Tunable.trusted_error: "",
}

# A value is sent as its place among them.
ESTIMATOR_CHOICES = {
    Tunable.kind: ("none", "gradient", "least_squares"),
}

# Lowest and highest.
RANGES = {
    Tunable.proportional_W_per_m: (0.0, 10000000.0),
    Tunable.integral_W_per_m_s: (0.0, 10000000.0),
    Tunable.derivative_Ws_per_m: (0.0, 10000000.0),
    Tunable.feedforward_W_per_m: (0.0, 10000000.0),
    Tunable.bandwidth_rad_per_s: (0.0, 100.0),
    Tunable.derivative_filter_rad_per_s: (0.1, 10000.0),
    Tunable.follow_s: (0.02, 3600.0),
    Tunable.forgetting_s: (1.0, 3600.0),
    Tunable.period_s: (0.0, 600.0),
    Tunable.filter_rad_per_s: (0.5, 100.0),
    Tunable.regression_rad_per_s: (0.5, 100.0),
    Tunable.change_W: (1e-06, 1000.0),
    Tunable.hold_s: (0.0, 3600.0),
    Tunable.model_pole_1_rad_per_s: (0.001, 1000.0),
    Tunable.model_pole_2_rad_per_s: (0.001, 1000.0),
    Tunable.model_pole_3_rad_per_s: (0.001, 1000.0),
    Tunable.adaptation_scale: (1e-06, 1000000.0),
    Tunable.gain_1: (1e-06, 1000000000000.0),
    Tunable.gain_2: (1e-06, 1000000000000.0),
    Tunable.gain_3: (1e-06, 1000000000000.0),
    Tunable.gain_4: (1e-06, 1000000000000.0),
    Tunable.normalisation: (0.0, 1000000.0),
    Tunable.window_s: (0.1, 3600.0),
    Tunable.min_ratio: (0.001, 1.0),
    Tunable.max_ratio: (1.0, 1000.0),
    Tunable.max_bias_W: (0.0, 1000.0),
    Tunable.position_noise_m: (1e-09, 0.01),
    Tunable.trusted_error: (1e-06, 1000.0),
}
