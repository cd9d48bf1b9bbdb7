// SPDX-License-Identifier: MIT OR Apache-2.0
// index_gate: Lets a pass begin at the encoder's index

`default_nettype none

module index_gate (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // wired: there is an index; otherwise the switch passes
    input  wire         wired,
    // start: the switch, as it comes
    input  wire         start,
    // started: the same, synchronised
    input  wire         started,
    // index: the index, synchronised
    input  wire         index,
    // open: the pass: from the first rise of index with started on
    output reg          open
);

    wire before_d;
    reg before_q;
    reg passed_d;
    reg passed_q;

    assign before_d = index;

    always @* begin
        passed_d = passed_q;
        if (~started) begin
            passed_d = 1'b0;
        end else if (index & ~before_q) begin
            passed_d = 1'b1;
        end
    end

    always @* begin
        if (wired) begin
            open = started & passed_q;
        end else begin
            open = start;
        end
    end

    initial begin
        before_q = 1'b0;
        passed_q = 1'b0;
    end

    always @(posedge clock) begin
        before_q <= before_d;
        passed_q <= passed_d;
    end
endmodule

`default_nettype wire
