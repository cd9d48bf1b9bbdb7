// The check is the remainder of the bits taken since clear, by x^16 + x^12 + x^5 + 1, inverted.

module frame_check_proof(input clock, input clear, input take, input level);
    wire [15:0] check;
    frame_check dut(.clock(clock), .clear(clear), .take(take), .level(level), .check(check));

    // The register of the standard, its highest power first.
    reg [15:0] powers;
    reg known = 0;
    wire out = powers[15] ^ level;
    always @(posedge clock) begin
        if (clear) begin
            known <= 1;
            powers <= 16'hffff;
        end else if (take) begin
            powers <= {powers[14:0], 1'b0} ^ (out ? 16'h1021 : 16'h0000);
        end
    end

    wire [15:0] turned;
    genvar i;
    generate
        for (i = 0; i < 16; i = i + 1) assign turned[i] = powers[15 - i];
    endgenerate

    always @* if (known) assert (check == ~turned);

    always @* cover (known && check == 16'h0f47);
endmodule
