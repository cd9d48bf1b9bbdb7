`timescale 1ps/100fs

// Delays of a gate primitive are inertial: a level that is told otherwise before its delay is over
// does not come. A path of a specify block lets such a pulse through in Icarus 11, so that with
// PATH_DELAYS the edges are the same only where nothing is swallowed.
module original_output #(parameter RISE = 1, FALL = 1) (output y, input s);
`ifdef PATH_DELAYS
  buf (y, s);
  specify
    specparam rise = RISE - 0.5, fall = FALL - 0.5;
    (s => y) = (rise, fall);
  endspecify
`else
  buf #(RISE - 0.5, FALL - 0.5) (y, s);
`endif
endmodule

module original_and #(parameter N = 1, RISE = 1, FALL = 1) (output y, input [N-1:0] a);
  wire s;
  assign #0.5 s = &a;
  original_output #(.RISE(RISE), .FALL(FALL)) made (y, s);
endmodule

module original_nand #(parameter N = 1, RISE = 1, FALL = 1) (output y, input [N-1:0] a);
  wire s;
  assign #0.5 s = ~&a;
  original_output #(.RISE(RISE), .FALL(FALL)) made (y, s);
endmodule

module original_or #(parameter N = 1, RISE = 1, FALL = 1) (output y, input [N-1:0] a);
  wire s;
  assign #0.5 s = |a;
  original_output #(.RISE(RISE), .FALL(FALL)) made (y, s);
endmodule

module original_nor #(parameter N = 1, RISE = 1, FALL = 1) (output y, input [N-1:0] a);
  wire s;
  assign #0.5 s = ~|a;
  original_output #(.RISE(RISE), .FALL(FALL)) made (y, s);
endmodule

module original_and_or_invert #(parameter N = 1, RISE = 1, FALL = 1) (output y, input [N-1:0] a);
  wire s;
  assign #0.5 s = ~((a[3] & a[2]) | (a[1] & a[0]));
  original_output #(.RISE(RISE), .FALL(FALL)) made (y, s);
endmodule

module original_delay #(parameter N = 1, RISE = 1, FALL = 1) (output y, input [N-1:0] a);
  wire s;
  assign #0.5 s = a[0];
  original_output #(.RISE(RISE), .FALL(FALL)) made (y, s);
endmodule

// The master listens while the clock is high and keeps what it heard; the slave takes it at the fall.
module original_jk #(
  parameter J = 1, K = 1, RISE = 1, FALL = 1, RISE_BAR = 1, FALL_BAR = 1, INIT = 1'b0, CLOCK = 1'b0
) (
  output q, q_bar, input clock, preset, clear, input [J-1:0] j, input [K-1:0] k
);
  reg slave, master, was;
  initial begin
    slave = INIT;
    master = INIT;
    was = CLOCK;
  end
  always @(clock or preset or clear or j or k) begin
    #0.5;
    if (!clear || !preset) begin
      slave = clear;
      master = slave;
    end else begin
      if (was && !clock) slave = master;
      if (!clock) master = slave;
      else if (slave && &k) master = 1'b0;
      else if (!slave && &j) master = 1'b1;
    end
    was = clock;
  end
  original_output #(.RISE(RISE), .FALL(FALL)) made (q, slave);
  original_output #(.RISE(RISE_BAR), .FALL(FALL_BAR)) made_bar (q_bar, ~slave);
endmodule
