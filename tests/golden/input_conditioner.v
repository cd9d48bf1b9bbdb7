// SPDX-License-Identifier: MIT OR Apache-2.0
// input_conditioner: Lets a level through once it has stood still: against glitches and bouncing

`default_nettype none

module input_conditioner (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // pin: line, fringe or switch, at any time
    input  wire         pin,
    // active_low: low on the pin means on
    input  wire         active_low,
    // tick: high for one clock: the time counts on
    input  wire         tick,
    // ticks: ticks that a new level has to stand; 0 is off
    input  wire [3:0]   ticks,
    // level: the level that stood; off: the pin itself, not synchronised
    output reg          level,
    // steady: the same, but synchronised in either case
    output reg          steady
);

    wire active;
    wire differs;
    wire [3:0] one_more;
    wire long_enough;
    wire synchroniser_level;
    reg settled_d;
    reg settled_q;
    reg [3:0] stood_d;
    reg [3:0] stood_q;

    level_synchroniser synchroniser (
        .clock(clock),
        .pin(active),
        .level(synchroniser_level)
    );

    assign active = pin ^ active_low;
    assign differs = synchroniser_level ^ settled_q;
    assign one_more = stood_q + 4'd1;
    assign long_enough = ticks <= one_more;

    always @* begin
        settled_d = settled_q;
        stood_d = stood_q;
        if (~differs) begin
            stood_d = 4'd0;
        end else if (tick & long_enough) begin
            stood_d = 4'd0;
            settled_d = synchroniser_level;
        end else if (tick) begin
            stood_d = one_more;
        end
    end

    always @* begin
        if (ticks == 4'd0) begin
            level = active;
            steady = synchroniser_level;
        end else begin
            level = settled_q;
            steady = settled_q;
        end
    end

    initial begin
        settled_q = 1'b0;
        stood_q = 4'd0;
    end

    always @(posedge clock) begin
        settled_q <= settled_d;
        stood_q <= stood_d;
    end
endmodule

`default_nettype wire
