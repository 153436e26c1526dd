#pragma once
/// Temperature of a gear from the power it turns into heat (docs/sources.md, facts D2). Pure.
///
///   dT/dt = (P R_th - (T - T_ambient)) / tau_th, solved exactly for a power that is constant over a step
namespace sprung {

/// Both zero: the temperature stays where it is.
struct ThermalParameters {
  double resistance_K_W = 0.0;
  double time_constant_s = 0.0;
  double ambient_C = 24.0;
  /// How well it is known what a gear starts from, one standard deviation. A hall in winter, a machine that
  /// has worked: 24 to 50 degC (docs/sources.md, facts D2) are within twice this.
  double ambient_std_K = 13.0;
};

class ThermalState {
 public:
  explicit ThermalState(const ThermalParameters& parameters) noexcept
      : parameters_(parameters), temperature_C_(parameters.ambient_C) {}

  void reset(double temperature_C) noexcept { temperature_C_ = temperature_C; }
  /// @param loss_W friction times velocity (and copper loss, where the winding heats the gear); not finite:
  /// as if it were 0. @return temperature_C()
  double step(double loss_W, double dt_s) noexcept;
  double temperature_C() const noexcept { return temperature_C_; }

 private:
  ThermalParameters parameters_;
  double temperature_C_;
};

}  // namespace sprung
