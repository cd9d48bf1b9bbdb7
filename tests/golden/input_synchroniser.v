// Two flip-flops and a rising edge: one pulse for each line or fringe

`default_nettype none

module input_synchroniser (
    input  wire         clock,
    input  wire         pin,
    output wire         rising
);

    reg first_d;
    reg first_q;
    reg second_d;
    reg second_q;
    reg before_d;
    reg before_q;

    always @* begin
        first_d = first_q;
        first_d = pin;
    end

    always @* begin
        second_d = second_q;
        second_d = first_q;
    end

    always @* begin
        before_d = before_q;
        before_d = second_q;
    end

    assign rising = second_q & ~before_q;

    initial begin
        first_q = 1'b0;
        second_q = 1'b0;
        before_q = 1'b0;
    end

    always @(posedge clock) begin
        first_q <= first_d;
        second_q <= second_d;
        before_q <= before_d;
    end
endmodule

`default_nettype wire
