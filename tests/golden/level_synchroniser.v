// Two flip-flops between a panel switch and the logic

`default_nettype none

module level_synchroniser (
    input  wire         clock,
    input  wire         pin,
    output wire         level
);

    reg first_d;
    reg first_q;
    reg second_d;
    reg second_q;

    always @* begin
        first_d = first_q;
        first_d = pin;
    end

    always @* begin
        second_d = second_q;
        second_d = first_q;
    end

    assign level = second_q;

    initial begin
        first_q = 1'b0;
        second_q = 1'b0;
    end

    always @(posedge clock) begin
        first_q <= first_d;
        second_q <= second_d;
    end
endmodule

`default_nettype wire
