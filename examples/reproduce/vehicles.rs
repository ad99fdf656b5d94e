//! Torques of vehicles, of several papers.

mod coupling;
mod drives;
mod flier;
mod hinge;
mod tilted;

use crate::table::{Group, Paper};

pub(crate) const PAPER: Paper = Paper {
    title: "Torques of vehicles",
    preface: "Sources: Ma, Felton and Wood (IROS 2012); Finio, Galloway and Wood (IROS 2011); Gravish and Wood (APS \
              March Meeting 2016, Y40.9); Weber, Dhingra and Fuller (arXiv 2407.00217, 2604.22121); Jimbo, Ozaki, \
              Ohta and Hamaguchi (arXiv 2407.06500); Fuller (RA-L 2019). Only their abstracts and first pages were \
              at hand. None of these pages gives wings, actuators and voltages of its robot fully, and few give \
              torques, so that mostly signs, trends and shares can be compared. Unless a row says otherwise the \
              vehicle is flap's own ([vehicle.md](../how-to/vehicle.md)): two wings of `jafferis2016` (200 V, 120 Hz), \
              shoulders 1.5 mm left and right of the middle, torques about a point 2 mm below them. x points \
              forward, y to the left, z up; roll > 0 lifts the left side, pitch > 0 lowers the nose, yaw > 0 turns \
              it to the left.",
    groups: &[
        Group {
            title: "One torque for each drive",
            preface: "Each drive alone, on top of the same sine for both wings: a difference of the amplitudes, left minus \
                      right, peak to peak; a bias of both wings; a second harmonic (split cycle), added on the left and \
                      taken away on the right, at the phase of the largest yaw. All three are a fifth of the amplitude.",
            quick: true,
            claims: drives::claims,
        },
        Group {
            title: "Roll and pitch at the same time",
            preface: "Weber, Dhingra and Fuller: a robot of 180 mg, the UW RoboFly. Commands: differences up to 40 V and \
                      biases up to 20 V to both sides, in five steps each, all 25 combinations. The range is assumed.",
            quick: true,
            claims: coupling::claims,
        },
        Group {
            title: "Split cycle and hinge",
            preface: "Gravish and Wood: one wing whose half-strokes last differently long, in simulation and experiment. \
                      Here the second harmonic is 0.2, and leads by 90°.",
            quick: true,
            claims: hinge::claims,
        },
        Group {
            title: "Four wings",
            preface: "Jimbo and others: a robot of 1.52 g whose wings, in four pairs, are tilted; here one wing of \
                      `ozaki2018-large` stands for each pair, 10 mm before or behind and left or right of the middle, \
                      tilted by 10°: those in front backward, those behind forward. Fuller: a robot of 143 mg; here four \
                      wings of `jafferis2016`. Both layouts are assumed.",
            quick: true,
            claims: tilted::claims,
        },
    ],
};
