// Rises with the start of a period only, falls with its middle only, low while cleared.

module standard_wave_proof(
    input clock, input clear, input divided, input start, input half, input range_x2
);
    wire standard;
    standard_wave dut(.clock(clock), .clear(clear), .divided(divided), .start(start), .half(half),
        .range_x2(range_x2), .standard(standard));

    reg was, cleared, started, middle;
    reg known = 0;
    always @(posedge clock) begin
        known <= 1;
        was <= standard;
        cleared <= clear;
        started <= start;
        middle <= range_x2 ? divided : half;
    end

    always @* if (known) begin
        if (cleared) assert (!standard);
        else if (started) assert (standard);
        else if (middle) assert (!standard);
        else assert (standard == was);
    end

    always @* cover (known && standard && was);
    always @* cover (known && !standard && was && !cleared);
endmodule
