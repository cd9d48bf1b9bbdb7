// SPDX-License-Identifier: MIT OR Apache-2.0
// quadrature_decoder: Lines of an encoder that may go back: those passed for the first time (fig.
// | 6)

`default_nettype none

module quadrature_decoder (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: nothing was gone back; each line forward is a pulse
    input  wire         clear,
    // a: the one photocell, synchronised
    input  wire         a,
    // b: the other, a quarter of a line behind it when going forward
    input  wire         b,
    // pulse: high for one clock: a line further than ever since clear
    output wire         pulse,
    // behind: lines gone back that are not made up for
    output wire [15:0]  behind,
    // lost: more of them than behind can hold: the count is not true
    output wire         lost
);

    wire up;
    wire down;
    wire none_owed;
    wire [15:0] one_more;
    wire [15:0] one_less;
    wire before_d;
    reg before_q;
    wire further_d;
    reg further_q;
    reg [15:0] owed_d;
    reg [15:0] owed_q;
    reg overrun_d;
    reg overrun_q;

    assign before_d = a;
    assign up = a & ~before_q & ~b;
    assign down = ~a & before_q & ~b;
    assign none_owed = ~(|owed_q);
    assign one_more = owed_q + 16'h1;
    assign one_less = owed_q - 16'h1;
    assign further_d = up & (none_owed | clear);

    always @* begin
        owed_d = owed_q;
        overrun_d = overrun_q;
        if (clear) begin
            owed_d = 16'h0;
            overrun_d = 1'b0;
        end else if (down & (&owed_q)) begin
            overrun_d = 1'b1;
        end else if (down) begin
            owed_d = one_more;
        end else if (up & ~none_owed) begin
            owed_d = one_less;
        end
    end

    assign pulse = further_q;
    assign behind = owed_q;
    assign lost = overrun_q;

    initial begin
        before_q = 1'b0;
        further_q = 1'b0;
        owed_q = 16'h0;
        overrun_q = 1'b0;
    end

    always @(posedge clock) begin
        before_q <= before_d;
        further_q <= further_d;
        owed_q <= owed_d;
        overrun_q <= overrun_d;
    end
endmodule

`default_nettype wire
