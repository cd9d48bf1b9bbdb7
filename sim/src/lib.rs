//! Cycle-accurate simulation of the device in closed loop with the machine.
