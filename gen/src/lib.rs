//! Files for a real FPGA, from a netlist.
