// Blocks or inserts one laser pulse in F (fig. 9)

`default_nettype none

module cumulative_compensator (
    input  wire         clock,
    input  wire         clear,
    input  wire         laser,
    input  wire [15:0]  preset,
    input  wire         insert,
    output wire         pulse
);

    wire pending;
    wire payable;
    wire divider_due;
    reg owed_d;
    reg owed_q;

    compensation_divider divider (
        .clock(clock),
        .clear(clear),
        .pulse(laser),
        .preset(preset),
        .due(divider_due)
    );

    assign pending = divider_due | owed_q;
    assign payable = laser ^ insert;

    always @* begin
        owed_d = owed_q;
        if (clear) begin
            owed_d = 1'b0;
        end else begin
            owed_d = pending & ~payable;
        end
    end

    assign pulse = laser ^ (pending & payable);

    initial begin
        owed_q = 1'b0;
    end

    always @(posedge clock) begin
        owed_q <= owed_d;
    end
endmodule

`default_nettype wire
