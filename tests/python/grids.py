"""Grids that several files of tests run."""

#: A grid with an axis of options, derived values, conditions, own measures, and points that fail in several ways.
GRID = """\
preset = "ozaki2018-large"

[params]
air_density = 1.2

[axes]
drive_voltage_pp = ["50 V", "80 V"]
lift_sign = ["corrected", "printed"]
drive_frequency = { from = "95 Hz", to = "125 Hz", n = 7 }

[derived]
hinge_stiffness = "preset.hinge_stiffness * (124 - drive_frequency) / 14"

[where]
not_hundred = "drive_frequency != 100"

[measure]
lift_per_volt = "lift_mean_mn / drive_voltage_pp"
strong = "lift_mean_mn > 2"

[solver]
newton = false
max_cycles = 24
"""

#: Some seconds of work for two workers.
LONG = 'preset = "ozaki2018-large"\n[axes]\ndrive_voltage_pp = [60, 80]\ndrive_frequency = { from = 95, to = 120, n = 4000 }\n'
