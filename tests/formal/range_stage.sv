// Every pulse at x1; at x2 the first, third, fifth ... after a clear, and those only.

module range_stage_proof(input clock, input clear, input divided, input range_x2);
    wire pulse;
    range_stage dut(.clock(clock), .clear(clear), .divided(divided), .range_x2(range_x2),
        .pulse(pulse));

    reg odd;
    reg known = 0;
    always @(posedge clock) begin
        if (clear) known <= 1;
        if (clear) odd <= 0;
        else odd <= odd ^ divided;
    end

    always @* if (!range_x2) assert (pulse == divided);
    always @* if (known && range_x2) assert (pulse == (divided && !odd));

    always @* cover (known && range_x2 && divided && !pulse);
endmodule
