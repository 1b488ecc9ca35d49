"""All that is said of studies with mistakes, word by word; of the structure of their tables above all."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from told import refused

from swtstudy import Study

#: What stands for these lines.
SHORT = {
    "{figure}": '[axes]\nphase = [0, 1]\nfriction = [0.1, 0.3]\n[figure]\nx = "phase"',
    "{drawn}": '[sample]\ndesign = "random"\nsize = 2',
    "{folder}": str(Path.cwd()),
}
#: Studies but for their titles, each with all that is said of it: every message begins with », and may go on
#: in lines that are set in.
TOLD = r"""
{figure}
hue = "frictoin"
» figure.hue: found 'frictoin', not an axis of this study; allowed: did you mean friction? known: phase,
  friction

{figure}
hue = "phase"
» figure.hue: found 'phase', also used for x; allowed: each axis once

{figure}
» figure: found no place for the axis friction; allowed: every axis as x, hue, vertical or panels, or with a
  single value

{figure}
hue = "friction"
panels = "profile"
» figure.panels: found 'profile', not an axis of this study; allowed: one of phase, friction

{figure}
hue = "friction"
y = []
» figure.y: found an empty list; allowed: at least one of s, s_error, critical_x, critical_angle, regime,
  s_surface, status, run, or "s/s(name=value)"

{figure}
hue = "friction"
y = "t"
» figure.y: found 't' (not a quantity); allowed: one of s, s_error, critical_x, critical_angle, regime,
  s_surface, status, run, "s/s(name=value)"

{figure}
hue = "friction"
y = ["s", "b/c"]
» figure.y: found 'b/c' (not a quantity); allowed: s, s_error, critical_x, critical_angle, regime,
  s_surface, status, run, or "s/s(name=value)"

{figure}
hue = "friction"
y = "s/s(foo=0)"
» figure.y: found 's/s(foo=0)' (unknown parameter foo); allowed: s, s_error, critical_x, critical_angle,
  regime, s_surface, status, run, or "s/s(name=value)"

{figure}
hue = "friction"
y = "s/s(friction=0.2)"
» figure.y: found 's/s(friction=0.2)': 0.2 is not on that axis; allowed: a value of the axis friction

{figure}
hue = "friction"
y = "s/s(normal_amplitude=0)"
» figure.y: found 's/s(normal_amplitude=0)': normal_amplitude is not an axis of this study; allowed: one of
  phase, friction

{figure}
hue = "friction"
y = "s/s(friction=-1)"
» figure.y: found 's/s(friction=-1)' (out of range); allowed: s, s_error, critical_x, critical_angle,
  regime, s_surface, status, run, or "s/s(name=value)"

{figure}
hue = "friction"
y = "s/s(µ=0.2)"
» figure.y: found 's/s(µ=0.2)': 0.2 is not on that axis; allowed: a value of the axis friction

{figure}
hue = "friction"
y = "s/s(profile=cylinder)"
» figure.y: found 's/s(profile=cylinder)': profile is not an axis of this study; allowed: one of phase,
  friction

{figure}
hue = "friction"
y = "von_mises"
» figure.y: found 'von_mises', which this study does not ask for; allowed: what it asks for, s, s_error,
  critical_x, critical_angle, regime, s_surface, status, run, or "s/s(name=value)"

{figure}
hue = "friction"
y = "counted"
» figure.y: found 'counted', which has several values at a point; allowed: cycles, which is made of it

{figure}
hue = "friction"
y = "bulk_shift"
» figure.y: found 'bulk_shift'; allowed: in a study with units; or s, s_error, critical_x, critical_angle,
  regime, s_surface, status, run

{figure}
hue = "friction"
y = "SWT"
» figure.y: found 'SWT'; allowed: in a study with units; or s, s_error, critical_x, critical_angle, regime,
  s_surface, status, run

{figure}
hue = "friction"
kind = "pie"
» figure.kind: found 'pie'; allowed: did you mean life? known: lines, life, contour, heatmap, scatter,
  histogram

{figure}
kind = "contour"
vertical = "friction"
hue = "friction"
» figure.hue: found 'friction', also used for vertical; allowed: each axis once
» figure.hue: found 'friction'; allowed: none for kind = "contour"

{figure}
kind = "contour"
» figure.vertical: found nothing; allowed: the name of an axis (kind = "contour" needs it)

{figure}
kind = "heatmap"
vertical = "friction"
regimes = true
validity = true
» figure.regimes: found true; allowed: false for kind = "heatmap"; kind = "contour" draws borders of
  regimes, and y = "regime" the regimes themselves

{figure}
kind = "life"
hue = "friction"
regimes = true
» figure.regimes: found true; allowed: false for kind = "life"

{figure}
kind = "histogram"
hue = "friction"
» figure.x: found 'phase'; allowed: "sample" for kind = "histogram"

{figure}
kind = "scatter"
» figure.x: found 'phase'; allowed: "sample" for kind = "scatter"
» figure: found no place for the axis friction; allowed: every axis as x, hue, vertical or panels, or with a
  single value

[axes]
phase = [0, 1]
friction = [0.1]
[figure]
x = "phase"
kind = "contour"
vertical = "friction"
» figure.vertical: found friction with a single value; allowed: an axis of two values or more

[axes]
phase = [0, 1]
friction = [0.1]
[figure]
x = "phase"
» figure: found no place for the axis friction; allowed: every axis as x, hue, vertical or panels, or with a
  single value

{figure}
hue = "friction"
vertical = "friction"
» figure.hue: found 'friction', also used for vertical; allowed: each axis once
» figure.vertical: found 'friction'; allowed: none for kind = "lines", whose vertical axis is y

[axes]
profile = ["paraboloid", "rounded_punch"]
phase = [0, 1]
[fixed]
flat_radius = 0.5
[figure]
x = "profile"
hue = "phase"
» figure.x: found 'profile'; allowed: an axis of numbers, and profile as hue or panels

[axes]
profile = ["paraboloid", "rounded_punch"]
phase = [0, 1]
[fixed]
flat_radius = 0.5
[figure]
kind = "contour"
x = "phase"
vertical = "profile"
» figure.vertical: found 'profile'; allowed: an axis of numbers, and profile as hue or panels

[figure]
x = "phase"
» figure.x: found 'phase', not an axis of this study; allowed: a figure needs an axis of numbers; swtstudy
  show STUDY draws one point

[figure]
y = 3
x = 1
kind = 2
title = 1
regimes = 0
colour = "red"
» figure.colour: found unknown key 'colour'; allowed: one of x, hue, panels, y, title, kind, vertical,
  regimes, validity, caption, message
» figure.kind: found 2; allowed: a text
» figure.regimes: found 0; allowed: true or false
» figure.title: found 1; allowed: a text
» figure.x: found 1; allowed: the name of an axis
» figure.y: found 3; allowed: a text, or a list of texts, such as "s" or "s/s(flat_radius=0)"

{figure}
hue = "friction"
title = 'an $\frca$'
» figure.title: found 'an $\\frca$' (Unknown symbol: \frca, found '\'  (at char 0), (line:1, col:1));
  allowed: a text; formulae between $ as in LaTeX

[sample.points]
phase = [0, 1]
[figure]
x = "phase"
» figure.x: found 'phase', not an axis of this study; allowed: one of sample

[sample.points]
phase = [0, 1]
[axes]
friction = [0.1, 0.2]
[figure]
x = "friction"
hue = "sample"
» figure.hue: found 'sample'; allowed: an axis; a sample is x of kind scatter or histogram

[axes]
critical_distance = [0.1, 0.2]
phase = [0, 1]
[figure]
x = "critical_distance"
regimes = true
» figure.x: found 'critical_distance', not an axis of s in this study; allowed: one of phase
» figure.regimes: found true over critical_distance; allowed: false: there is one regime at a point

[axes]
critical_distance = [0.1, 0.2]
[figure]
x = "phase"
y = ["s_volume", "s"]
» figure.x: found 'phase', not an axis of s_volume in this study; allowed: one of critical_distance
» figure.x: found 'phase', not an axis of s in this study; allowed: a figure needs an axis of numbers;
  swtstudy show STUDY draws one point

[fixed]
critical_distance = 0.1
[axes]
phase = [0, 1]
[figure]
x = "phase"
y = "s_line"
» figure: found no place for the axis direction; allowed: every axis as x, hue, vertical or panels, or with
  a single value

[axes]
phase = []
» axes.phase: found an empty axis; allowed: at least one value

[axes]
phase = 0
» axes.phase: found 0; allowed: a list of values or {start, stop, num}

[axes]
phase = {start = 0}
» axes.phase.num: found nothing; allowed: a whole number
» axes.phase.stop: found nothing; allowed: a number, or text such as "2*pi"

[axes]
phase = {start = 0, stop = "x", num = 1, also = 3, spacing = "cubic"}
» axes.phase.also: found 3; allowed: a list of values
» axes.phase.spacing: found 'cubic'; allowed: "linear" or "log"

[axes]
phase = {start = "x", stop = "y", num = 3}
» axes.phase.start: found 'x' (not a number or an expression of numbers, pi, sqrt(), + - * / ( )); allowed:
  a number, or text such as "2*pi"
» axes.phase.stop: found 'y' (not a number or an expression of numbers, pi, sqrt(), + - * / ( )); allowed: a
  number, or text such as "2*pi"

[axes]
phase = {start = 0, stop = 0, num = 2}
» axes.phase: found start and stop are both 0; allowed: two different ends

[axes]
friction = {start = -1, stop = 1, num = 3, spacing = "log"}
» axes.friction: found equal ratios from -1 to 1; allowed: two positive ends

[axes]
friction = {start = 0.1, stop = 1, num = 1000001}
» axes.friction.num: found 1000001; allowed: a whole number from 2 to 1000000

[axes]
friction = {start = 0, stop = 1, num = 3, also = [0.5, "x", 0.2, 0.2]}
» axes.friction.also[0]: found 0.5, the same as axes.friction[1]; allowed: distinct values
» axes.friction.also[1]: found 'x' (not a number or an expression of numbers, pi, sqrt(), + - * / ( ));
  allowed: a number in [0, 10]
» axes.friction.also[3]: found 0.2, the same as axes.friction.also[2]; allowed: distinct values

[axes]
friction = [0.1]
[fixed]
friction = 0.2
[sample.points]
friction = [0.3]
» sample.friction: found both a fixed value and an axis; allowed: one of the two
» sample.friction: found both a fixed value and sampled; allowed: one of the two
» sample.friction: found both an axis and sampled; allowed: one of the two

[axes]
profile = "cylinder"
» axes.profile: found 'cylinder'; allowed: a list of values or {start, stop, num}

[fixed]
friction = [0.1]
profile = ["cylinder"]
phase = {start = 0}
» fixed.friction: found [0.1] (not a number); allowed: a number in [0, 10]; several values under [axes]
» fixed.profile: found ['cylinder'] (not a name); allowed: one of paraboloid, rounded_punch,
  truncated_paraboloid, wavy_paraboloid, power_law, cylinder, rounded_flat, wavy_cylinder, power_law_cylinder;
  your own: [profiles.NAME] in a study, swtstudy.TabulatedProfile in Python; several values under [axes]
» fixed.phase: found {'start': 0} (not a number); allowed: a finite angle in [-1000, 1000] rad, or "90 deg";
  several values under [axes]

[fixed]
radius = 3
frictoin = 3
[axes]
x = [1]
» fixed.radius: found a parameter of real contacts; allowed: this in a study with [units], or
  swtstudy.physical
» fixed.frictoin: found unknown parameter 'frictoin'; allowed: did you mean friction? known: poisson_ratio,
  friction, normal_amplitude, normal_force_amplitude, frequency_ratio, tangential_amplitude,
  tangential_force_amplitude, phase, load, profile, flat_radius, flat_half_width, waviness_amplitude,
  wavelength, exponent, bulk_stress_amplitude, bulk_stress_mean, bulk_stress_phase, bulk_strain_share,
  stick_zone_shift, criterion, walker_exponent, normal_sensitivity, critical_distance
» axes.x: found unknown parameter 'x'; allowed: one of poisson_ratio, friction, normal_amplitude,
  normal_force_amplitude, frequency_ratio, tangential_amplitude, tangential_force_amplitude, phase, load,
  profile, flat_radius, flat_half_width, waviness_amplitude, wavelength, exponent, bulk_stress_amplitude,
  bulk_stress_mean, bulk_stress_phase, bulk_strain_share, stick_zone_shift, criterion, walker_exponent,
  normal_sensitivity, critical_distance

title = 3
» title: found 3; allowed: a text that is not empty

rtol = 2
rtoll = 1
loads = 3
profiles = [1]
blocks = {}
units = 3
material = 4
sample = 5
fixed = 6
axes = 7
figure = 8
quantities = 9
» axes: found 7; allowed: a table of axes
» blocks: found {}; allowed: [[blocks]] with load and rounds
» figure: found 8; allowed: a table with x and, optionally, hue, panels, y, title, kind, vertical, regimes,
  validity, caption and message
» fixed: found 6; allowed: a table of single values
» loads: found 3; allowed: a table of loops, [loads.NAME]
» material: found 4; allowed: a table of fatigue constants
» profiles: found [1]; allowed: a table of profiles, [profiles.NAME]
» rtol: found 2; allowed: a number in [1e-07, 0.1]
» rtoll: found unknown key 'rtoll'; allowed: did you mean rtol? known: title, rtol, quantities, fixed, axes,
  sample, units, material, loads, profiles, blocks, figure
» sample: found 5; allowed: a table with design, size and ranges, with points, or with file
» units: found 3; allowed: a table with length, force and stress
» quantities: found 9; allowed: a list of dissipation, stick_radius, stick_left, stick_right,
  contact_radius, force_ratio, von_mises

quantities = ["dissipation", "foo", "dissipation"]
» quantities[1]: found unknown quantity 'foo'; allowed: one of dissipation, stick_radius, stick_left,
  stick_right, contact_radius, force_ratio, von_mises
» quantities[2]: found 'dissipation', the same as quantities[0]; allowed: each quantity once

fixed.load = "a"
blocks = [{load = "a", rounds = 2}]
» blocks: found blocks without [units] and [material]; allowed: with both: Miner's sum needs lives
» fixed.load: found 'a'; allowed: nothing: [[blocks]] give the loads
» blocks.load: found 'a' (no such load); allowed: one of harmonic; your own: [loads.a] in a study,
  swtstudy.LoadPath in Python

[loads.a]
[profiles.b]
» loads.a: found nothing; allowed: a table with vertices, with normal and tangential, or with file
» profiles.b: found nothing; allowed: a table with radius and height, or file

[loads]
a = 3
[profiles]
b = 4
» loads.a: found 3; allowed: a table with vertices, with normal and tangential, or with file
» profiles.b: found 4; allowed: a table with radius and height, or file

[loads.a]
vertices = [[0, 1], [0, -1]]
file = "x"
» loads.a: found vertices and file; allowed: a table with vertices, with normal and tangential, or with file

[loads.a]
vertices = [[0, 1], [0, -1]]
harmonics = 3
mean_normal = 1
» loads.a: found harmonics beside vertices; allowed: beside vertices only absolute, mean_normal

[loads.a]
normal = [[1, 1, 0]]
tangential = [[1, 1, "x"]]
» loads.a: found 'x' (not a number or an expression of numbers, pi, sqrt(), + - * / ( )) (tangential[0]);
  allowed: a phase

[loads.a]
normal = [[1, 1, 0]]
tangential = [[1, 1, 0]]
absolute = true
» loads.a: found absolute beside normal and tangential; allowed: beside normal and tangential only bulk,
  mean_normal

[loads.a]
vertices = [[0, 1], [0, -1]]
absolute = true
mean_normal = 2
» loads.a.absolute: found absolute and mean_normal; allowed: true or false; without mean_normal

[loads.a]
vertices = [[0, 1], [0, -1]]
absolute = true
» loads.a.vertices: found 0 (mean_normal of a); allowed: a positive number: bodies are pressed

[profiles.b]
radius = [0, 1]
» profiles.b: found radius; allowed: a table with radius and height, or file

[profiles.b]
radius = [0, 1]
height = [0, 1]
level = true
» profiles.b: found level beside radius and height; allowed: beside radius and height only smoothing,
  geometry

[profiles.b]
file = "x.csv"
level = true
» profiles.b: found level; allowed: level with two_sided only

[profiles.b]
file = "x.csv"
geometry = "round"
smoothing = "x"
separator = "x"
decimal = 1
skip_rows = -1
units_row = 3
sheet = 1.5
columns = 3
scale = 4
encoding = 3
» profiles.b.columns: found 3; allowed: a table of headers, such as { normal = "Fn [N]" }
» profiles.b.decimal: found 1; allowed: one of '.', ','
» profiles.b.encoding: found 3; allowed: the name of an encoding, such as "cp1252"
» profiles.b.scale: found 4; allowed: a table of numbers, such as { normal = 1000 }
» profiles.b.separator: found 'x'; allowed: one of ',', ';', '\t', '|', ' '
» profiles.b.sheet: found 1.5; allowed: the name of a sheet, or its number from 1 on
» profiles.b.skip_rows: found -1; allowed: a whole number of lines, 0 or more
» profiles.b.units_row: found 3; allowed: true or false

[loads.a]
file = "x.csv"
period = 0
frequency = inf
recorded_cycles = 0
harmonics = 0
time = ""
despike = 1
keep_cycles = 1
absolute = 1
» loads.a.absolute: found 1; allowed: true or false
» loads.a.despike: found 1; allowed: true or false
» loads.a.frequency: found inf; allowed: a positive number
» loads.a.harmonics: found 0; allowed: a whole number, 1 to 64
» loads.a.keep_cycles: found 1; allowed: true or false
» loads.a.period: found 0; allowed: a positive number
» loads.a.recorded_cycles: found 0; allowed: a whole number of cycles, 1 or more
» loads.a.time: found ''; allowed: the header of the column of the time

[[blocks]]
load = "a"
[[blocks]]
rounds = 3
[[blocks]]
load = 3
rounds = "x"
foo = 3
» blocks[0].rounds: found nothing; allowed: [[blocks]] with load and rounds
» blocks[1].load: found nothing; allowed: the name of a load
» blocks[2].foo: found unknown key 'foo'; allowed: one of load, rounds
» blocks[2].load: found 3; allowed: the name of a load
» blocks: found blocks without [units] and [material]; allowed: with both: Miner's sum needs lives
» blocks.load: found 'a' (no such load); allowed: one of harmonic; your own: [loads.a] in a study,
  swtstudy.LoadPath in Python

material = {strength = 3}
» material: found constants without [units]; allowed: with [units] only: a life needs a real contact

units = {}
[[blocks]]
load = "harmonic"
rounds = -1
» blocks: found blocks without [units] and [material]; allowed: with both: Miner's sum needs lives
» blocks[0].rounds: found -1; allowed: a positive number of rounds
» units.length: found nothing; allowed: the name of a unit, such as 'm'
» units.force: found nothing; allowed: the name of a unit, such as 'N'
» units.stress: found nothing; allowed: the name of a unit, such as 'Pa'
» fixed.young_modulus: found nothing; allowed: a positive stress in the unit of stress
» fixed.poisson_ratio: found nothing; allowed: a number in [0, 0.5]
» fixed.radius: found nothing; allowed: a positive length in the unit of length
» fixed.friction: found nothing; allowed: a number in [0, 10]
» fixed.depth, fixed.normal_force: found neither; allowed: one of the two: it says how deep the contact is
» fixed.tangential_amplitude: found nothing; allowed: a length in the unit of length, ≥ 0; or
  tangential_force_amplitude

sample = {}
» sample: found nothing; allowed: one of: design, size and ranges; or file; or points

[sample]
design = "sobl"
size = 4
ranges.phase = [0, 1]
» sample.design: found 'sobl'; allowed: "sobol", "latin_hypercube", "random" or "saltelli"

[sample]
design = "sobol"
size = 5
ranges.phase = [0, 1]
» sample.size: found 5; allowed: a power of 2 from 1 to 1000000

[sample]
design = "saltelli"
size = 262144
ranges = {phase = [0, 1], friction = [0, 1]}
» sample.size: found 1048576 points; allowed: at most 1000000 points

[sample]
design = "saltelli"
size = 6
ranges.phase = [0, 1]
» sample.size: found 6; allowed: a power of 2 from 1 to 1000000

[sample]
design = "random"
size = 0
seed = -1
file = 3
points = 4
ranges = 5
covariance = 6
target_life = "x"
» sample.covariance: found 6; allowed: a table of covariances
» sample.file: found 3; allowed: the path of a CSV file
» sample.points: found 4; allowed: a table of lists of values
» sample.ranges: found 5; allowed: a table of ranges
» sample.seed: found -1; allowed: a whole number from 0 to 4294967295
» sample.size: found 0; allowed: a whole number from 1 to 1000000
» sample.target_life: found 'x'; allowed: a number
» sample: found design and file and points; allowed: one of: design, size and ranges; or file; or points

[sample]
design = "random"
ranges.phase = [0, 1]
» sample.size: found nothing; allowed: a whole number from 1 to 1000000

[sample]
design = "random"
size = 2
» sample.ranges: found nothing; allowed: at least one parameter with its range

[sample]
design = "random"
size = 1000001
ranges.phase = [0, 1]
» sample.size: found 1000001; allowed: a whole number from 1 to 1000000

[sample]
points.phase = [0, 1]
size = 3
seed = 1
ranges.friction = [0, 1]
» sample.size: found 3 beside points; allowed: only with a design
» sample.seed: found 1 beside points; allowed: only with a design
» sample.ranges: found {'friction': [0, 1]} beside points; allowed: only with a design

{drawn}
file = "x"
points.phase = [1]
» sample: found design and file and points; allowed: one of: design, size and ranges; or file; or points

[sample]
points = {phase = [1, "x", "y"], friction = [1, 2, 3]}
» sample.points.phase: found 'x' (not a number or an expression of numbers, pi, sqrt(), + - * / ( )) at [1];
  1 more like it; allowed: a finite angle in [-1000, 1000] rad, or "90 deg"

[sample]
points = {phase = [1, 2], foo = [1, 2]}
» sample.points.foo: found unknown parameter 'foo'; allowed: one of poisson_ratio, friction,
  normal_amplitude, normal_force_amplitude, frequency_ratio, tangential_amplitude, tangential_force_amplitude,
  phase, load, profile, flat_radius, flat_half_width, waviness_amplitude, wavelength, exponent,
  bulk_stress_amplitude, bulk_stress_mean, bulk_stress_phase, bulk_strain_share, stick_zone_shift, criterion,
  walker_exponent, normal_sensitivity

[sample]
points = {phase = [], friction = []}
» sample.points: found no points; allowed: at least one point

[sample]
points = {phase = 3}
» sample.points.phase: found 3; allowed: a table of lists of values
» sample.points: found no points; allowed: at least one point

[sample.points]
strength = [1, 2]
» sample: found constants that scatter; allowed: with the constants of lives in [material]

{drawn}
target_life = 100
ranges.phase = [0, 1]
» sample: found constants that scatter; allowed: with the constants of lives in [material]

{drawn}
ranges.phase = 1
» sample.ranges.phase: found 1; allowed: both ends, [low, high], or a table such as {distribution =
  "normal", mean = …, deviation = …}

{drawn}
ranges.phase = [2, 1]
» sample.ranges.phase: found the bounds 2 and 1; allowed: the lower bound first, and a higher one

{drawn}
ranges.phase = [1, 1]
» sample.ranges.phase: found the bounds 1 and 1; allowed: the lower bound first, and a higher one

{drawn}
ranges.phase = [1, 2, 3]
» sample.ranges.phase: found [1, 2, 3]; allowed: both ends, [low, high], or a table such as {distribution =
  "normal", mean = …, deviation = …}

{drawn}
ranges.friction = [-1, 11]
» sample.ranges.friction.low: found -1 (out of range); allowed: a number in [0, 10]
» sample.ranges.friction.high: found 11 (out of range); allowed: a number in [0, 10]

{drawn}
ranges.friction = {low = 0, high = 1}
» sample.ranges.friction.distribution: found nothing; allowed: one of uniform, triangular, normal, lognormal

{drawn}
ranges.friction = {distribution = "norml"}
» sample.ranges.friction.distribution: found 'norml'; allowed: did you mean normal? known: uniform,
  triangular, normal, lognormal

{drawn}
ranges.friction = {distribution = "normal", mean = 1, sd = 3}
» sample.ranges.friction.sd: found unknown key 'sd'; allowed: one of distribution, low, high, mean,
  deviation
» sample.ranges.friction.deviation: found nothing; allowed: a number

{drawn}
ranges.friction = {distribution = "normal", mean = 1, deviation = 0}
» sample.ranges.friction.deviation: found 0; allowed: a number greater than 0

{drawn}
ranges.friction = {distribution = "normal", mean = "x", deviation = "1/0"}
» sample.ranges.friction.mean: found 'x' (not a number or an expression of numbers, pi, sqrt(), + - * / (
  )); allowed: a number
» sample.ranges.friction.deviation: found '1/0' (division by zero); allowed: a number

{drawn}
ranges.friction = {distribution = "lognormal", median = 0, deviation = 1}
» sample.ranges.friction.median: found 0; allowed: a number greater than 0

{drawn}
ranges.friction = {distribution = "lognormal", median = 1, deviation = 3}
» sample.ranges.friction.deviation: found 3, as a factor 20.1; allowed: that of the natural logarithm, at
  most 2.3: about the relative one

{drawn}
ranges.friction = {distribution = "triangular", low = 0, high = 1, mode = 2}
» sample.ranges.friction.mode: found 2; allowed: a number in [0, 1]

{drawn}
ranges.friction = {distribution = "triangular", low = 0.5, high = 1, mode = 0.2}
» sample.ranges.friction.mode: found 0.2; allowed: a number in [0.5, 1]

{drawn}
ranges.friction = {distribution = "uniform"}
» sample.ranges.friction.low: found nothing; allowed: a number in [0, 10]
» sample.ranges.friction.high: found nothing; allowed: a number in [0, 10]

{drawn}
ranges.friction = {distribution = "normal", mean = 10, deviation = 0.1, high = 1}
» sample.ranges.friction: found the bounds 0 and 1, which hold none of the distribution; allowed: bounds
  that hold some of it

{drawn}
ranges.profile = [0, 1]
» sample.ranges.profile: found profile, which is not a number; allowed: an axis, or points from a file

{drawn}
ranges.foo = [0, 1]
» sample.ranges.foo: found unknown parameter 'foo'; allowed: one of poisson_ratio, friction,
  normal_amplitude, normal_force_amplitude, tangential_amplitude, tangential_force_amplitude, phase,
  flat_radius, flat_half_width, waviness_amplitude, wavelength, exponent, bulk_stress_amplitude,
  bulk_stress_mean, bulk_stress_phase, bulk_strain_share, walker_exponent, normal_sensitivity

{drawn}
ranges.frequency_ratio = [1, 2]
» sample.ranges.frequency_ratio: found frequency_ratio, which is not a number; allowed: an axis, or points
  from a file

{drawn}
ranges.strength = [1, 2]
» sample: found constants that scatter; allowed: with the constants of lives in [material]

{drawn}
ranges.yield_strength = [1, 2]
» sample.ranges.yield_strength: found yield_strength, a constant that cannot scatter; allowed: constants
  that can: strength, strength_exponent, ductility, ductility_exponent, with shear_ before it in torsion, with
  _1 or _2 behind it of one body; or a parameter

{drawn}
ranges.friction = {distribution = 3}
» sample.ranges.friction.distribution: found 3; allowed: one of uniform, triangular, normal, lognormal

[sample]
file = "none.csv"
» sample.file: found no such file in the folder {folder} (none.csv); allowed: a CSV file that can be read
"""


@pytest.mark.parametrize("case", TOLD.strip().split("\n\n"))
def test_whole_messages(case: str) -> None:
    for words, meant in SHORT.items():
        case = case.replace(words, meant)
    text, *lines = re.sub(r"\n  ", " ", case).split("\n» ")
    title = "" if text.startswith("title") else 'title = "t"\n'
    told = refused("", Study.from_text, f"{title}{text}\n", "s").mistakes
    assert [*map(str, told)] == [f"s: {line}" for line in lines]
