//! Torques of vehicles, of several papers.

mod coupling;
mod drives;
mod flier;
mod hinge;
mod tilted;

use crate::table::{Group, Paper};

pub(crate) const PAPER: Paper = Paper {
    title: "Torques of vehicles",
    preface: "These statements come from several papers:\n\
              \n\
              - Ma, Felton and Wood (IROS 2012)\n\
              - Finio, Galloway and Wood (IROS 2011)\n\
              - Gravish and Wood (APS March Meeting 2016, Y40.9)\n\
              - Weber, Dhingra and Fuller (arXiv 2407.00217, 2604.22121)\n\
              - Jimbo, Ozaki, Ohta and Hamaguchi (arXiv 2407.06500)\n\
              - Fuller (RA-L 2019)\n\
              \n\
              Only their abstracts and first pages were available.\n\
              These pages give no robot completely (wings, actuators and voltages), and few give torques.\n\
              You can therefore compare mostly signs, trends and ratios.\n\
              \n\
              Unless a row gives another one, the vehicle ([Forces and torques of vehicles](../how-to/vehicle.md)) has two wings of `jafferis2016` at 200 V and 120 Hz.\n\
              Their shoulders are 1.5 mm left and right of the middle.\n\
              Torques are about a point 2 mm below the shoulders, in [body axes](../glossary.md#body-axes): x points forward, y left and z up.\n\
              A positive roll lifts the left side, a positive pitch lowers the nose, and a positive yaw turns the nose to the left.",
    groups: &[
        Group {
            title: "One torque for each drive",
            preface: "Each row changes one drive, on top of the same sine for both wings:\n\
                      \n\
                      - roll: a difference of the amplitudes, left minus right, peak to peak\n\
                      - pitch: a bias of both wings\n\
                      - yaw: a second harmonic (split cycle), added on the left and subtracted on the right, at the phase of the largest yaw\n\
                      \n\
                      On each wing, the change is a fifth of the amplitude.",
            quick: true,
            claims: drives::claims,
        },
        Group {
            title: "Roll and pitch at the same time",
            preface: "The robot of Weber, Dhingra and Fuller is the UW RoboFly with a mass of 180 mg.\n\
                      The commands are differences up to 40 V and biases up to 20 V to both sides, in five steps each: 25 combinations.\n\
                      This range is assumed.",
            quick: true,
            claims: coupling::claims,
        },
        Group {
            title: "Split cycle and hinge",
            preface: "Gravish and Wood study one wing with half-strokes of different durations, in simulation and experiment.\n\
                      Here the second harmonic is 0.2 and leads by 90°.",
            quick: true,
            claims: hinge::claims,
        },
        Group {
            title: "Four wings",
            preface: "The robot of Jimbo and others has a mass of 1.52 g and four pairs of tilted wings.\n\
                      Here one wing of `ozaki2018-large` represents each pair, 10 mm in front of or behind and left or right of the middle.\n\
                      The front wings are tilted backward by 10°, the rear wings forward by 10°.\n\
                      The robot of Fuller has a mass of 143 mg; here it is four wings of `jafferis2016`.\n\
                      Both layouts are assumed.",
            quick: true,
            claims: tilted::claims,
        },
    ],
};
