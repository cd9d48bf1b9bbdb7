// Legal one clock after any state; a step forward and a step back lead to where it was.

module ring_distributor_proof(input clock, input clear, input step, input forward);
    wire a, b, c;
    ring_distributor dut(.clock(clock), .clear(clear), .step(step), .forward(forward),
        .phase_a(a), .phase_b(b), .phase_c(c));

    function [2:0] after(input [2:0] abc);
        case (abc)
            3'b100: after = 3'b110;
            3'b110: after = 3'b010;
            3'b010: after = 3'b011;
            3'b011: after = 3'b001;
            3'b001: after = 3'b101;
            3'b101: after = 3'b100;
            default: after = 3'b100;
        endcase
    endfunction

    reg [2:0] was;
    reg cleared, stepped, went_forward;
    reg known = 0;
    always @(posedge clock) begin
        known <= 1;
        was <= {a, b, c};
        {cleared, stepped, went_forward} <= {clear, step, forward};
    end

    always @* if (known) begin
        assert (!(a == b && b == c));
        if (cleared || was == 0 || was == 7) assert ({a, b, c} == 3'b100);
        else if (stepped && went_forward) assert ({a, b, c} == after(was));
        else if (stepped) assert (after({a, b, c}) == was);
        else assert ({a, b, c} == was);
    end

    always @* cover (known && was == 7);
    always @* cover (known && {a, b, c} == 3'b011 && went_forward);
endmodule
