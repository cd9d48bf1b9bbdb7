// Divides by a further two in the x2 range

`default_nettype none

module range_stage (
    input  wire         clock,
    input  wire         clear,
    input  wire         divided,
    input  wire         range_x2,
    output wire         pulse
);

    reg second_d;
    reg second_q;

    always @* begin
        second_d = second_q;
        if (clear) begin
            second_d = 1'b0;
        end else if (divided) begin
            second_d = ~second_q;
        end
    end

    assign pulse = divided & ~(second_q & range_x2);

    initial begin
        second_q = 1'b0;
    end

    always @(posedge clock) begin
        second_q <= second_d;
    end
endmodule

`default_nettype wire
