//! Claims of several papers about the torques of vehicles.

mod coupling;
mod damping;
mod drives;
mod flier;
mod hinge;
mod tilted;

use crate::table::{Group, Paper};

pub(crate) const PAPER: Paper = Paper {
    title: "Torques of vehicles",
    preface: "The statements in the tables on vehicles come from these papers:\n\
              \n\
              - Ma, Felton and Wood (IROS 2012)\n\
              - Finio, Galloway and Wood (IROS 2011)\n\
              - Gravish and Wood (APS March Meeting 2016, Y40.9)\n\
              - Weber, Dhingra and Fuller (arXiv 2407.00217, 2604.22121)\n\
              - Jimbo, Ozaki, Ohta and Hamaguchi (arXiv 2407.06500)\n\
              - Fuller (RA-L 2019)\n\
              - the simulators Robofly_simulator (dd292) and robobee_simulator (franklin-h), which are source code\n\
              \n\
              Only the abstracts and first pages of the papers on vehicles were available.\n\
              No available page describes the wings, the actuators and the voltages of a robot completely, and few pages give torques.\n\
              You can therefore compare mostly signs, trends and ratios of the torques.\n\
              \n\
              If a section describes no vehicle, the vehicle has two wings of the preset `jafferis2016` at 200 V and 120 Hz.\n\
              [Forces and torques of vehicles](../how-to/vehicle.md) describes how to simulate a vehicle with several wings.\n\
              The shoulders of the two wings are 1.5 mm left and right of the middle of the vehicle.\n\
              Torques are computed about a point 2 mm below the shoulders, in [body axes](../glossary.md#body-axes): x points forward, y left and z up.\n\
              A positive roll torque lifts the left side of the vehicle.\n\
              A positive pitch torque lowers the nose, and a positive yaw torque turns the nose to the left.",
    groups: &[
        Group {
            title: "One torque for each drive",
            preface: "Both wings are driven by the same sine voltage, and each row adds one change to the drive:\n\
                      \n\
                      - For roll, the peak-to-peak voltage of the left wing is larger than the voltage of the right wing.\n\
                      - For pitch, both wings have the same bias voltage.\n\
                      - For yaw, a second harmonic (split cycle) is added on the left and subtracted on the right, at the phase with the largest yaw torque.\n\
                      \n\
                      On each wing, the change of the drive is a fifth of the drive amplitude.",
            quick: true,
            claims: drives::claims,
        },
        Group {
            title: "Roll and pitch at the same time",
            preface: "The robot of Weber, Dhingra and Fuller is the UW RoboFly with a mass of 180 mg.\n\
                      The roll command is a difference of the drive voltages (left minus right) from -40 V to 40 V.\n\
                      The pitch command is a bias voltage of both wings from -20 V to 20 V.\n\
                      Five values of the roll command and five values of the pitch command give 25 combinations.\n\
                      The ranges of the two commands are assumed.",
            quick: true,
            claims: coupling::claims,
        },
        Group {
            title: "Split cycle and hinge",
            preface: "Gravish and Wood study one wing with half strokes of different durations, in simulation and experiment.\n\
                      In the rows of this section, the second harmonic has 0.2 times the amplitude of the drive and a phase of 90°.",
            quick: true,
            claims: hinge::claims,
        },
        Group {
            title: "Four wings",
            preface: "The robot of Jimbo and others has a mass of 1.52 g and four pairs of tilted wings.\n\
                      In the simulated vehicle, one wing of the preset `ozaki2018-large` represents each pair of wings.\n\
                      Each wing is 10 mm in front of or behind the middle of the vehicle, and 10 mm left or right of the middle.\n\
                      The front wings are tilted backward by 10°, and the rear wings are tilted forward by 10°.\n\
                      The robot of Fuller has a mass of 143 mg and is represented by four wings of the preset `jafferis2016`.\n\
                      The arrangements of the wings in both four-wing vehicles are assumed.",
            quick: true,
            claims: tilted::claims,
        },
        Group {
            title: "Damping of the body's motion",
            preface: "Two simulators of flapping-wing robots contain constants for the damping of the body's motion by the wings.\n\
                      Robofly_simulator contains constants from a wind tunnel, but the wings, the drive and the lift of the tested robot are not known.\n\
                      For the comparison with Robofly_simulator, the vehicle has the preset `jafferis2016` at 140 V and 120 Hz.\n\
                      For the comparison with robobee_simulator, the vehicle has the preset `jafferis2016-improved` at 165 V and 155 Hz.\n\
                      The wings are 2 mm left and right of the middle, and 3 mm above the centre of mass.",
            quick: true,
            claims: damping::claims,
        },
    ],
};
