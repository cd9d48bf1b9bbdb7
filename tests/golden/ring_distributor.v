// SPDX-License-Identifier: MIT OR Apache-2.0
// ring_distributor: Three phases, six steps, and a way out of the two illegal states (fig. 14)

`default_nettype none

module ring_distributor (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: to phase A alone
    input  wire         clear,
    // step: high for one clock: one step, 0.0125 µm at the table
    input  wire         step,
    // forward: direction of that step
    input  wire         forward,
    // phase_a: drives of the three windings, registered
    output wire         phase_a,
    // phase_b: drives of the three windings, registered
    output wire         phase_b,
    // phase_c: drives of the three windings, registered
    output wire         phase_c
);

    wire illegal;
    reg a_d;
    reg a_q;
    reg b_d;
    reg b_q;
    reg c_d;
    reg c_q;

    assign illegal = (a_q == b_q) & (b_q == c_q);

    always @* begin
        a_d = a_q;
        b_d = b_q;
        c_d = c_q;
        if (clear | illegal) begin
            a_d = 1'b1;
            b_d = 1'b0;
            c_d = 1'b0;
        end else if (step & forward) begin
            a_d = ~b_q;
            b_d = ~c_q;
            c_d = ~a_q;
        end else if (step) begin
            a_d = ~c_q;
            b_d = ~a_q;
            c_d = ~b_q;
        end
    end

    assign phase_a = a_q;
    assign phase_b = b_q;
    assign phase_c = c_q;

    initial begin
        a_q = 1'b0;
        b_q = 1'b0;
        c_q = 1'b0;
    end

    always @(posedge clock) begin
        a_q <= a_d;
        b_q <= b_d;
        c_q <= c_d;
    end
endmodule

`default_nettype wire
