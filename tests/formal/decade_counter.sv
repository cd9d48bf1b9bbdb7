// The digit counts in tens from any state on; carry marks the overflow; clear comes before count.

module decade_counter_proof(input clock, input clear, input count);
    wire [3:0] digit;
    wire carry;
    decade_counter dut(.clock(clock), .clear(clear), .count(count), .digit(digit), .carry(carry));

    reg [3:0] was;
    reg cleared, counted;
    reg known = 0;
    reg legal = 0;
    always @(posedge clock) begin
        was <= digit;
        cleared <= clear;
        counted <= count;
        known <= 1;
        if (clear || count) legal <= legal || clear || digit >= 9;
    end

    always @* if (known) begin
        if (cleared) assert (digit == counted);
        else if (!counted) assert (digit == was);
        else if (was >= 9) assert (digit == 0);
        else assert (digit == was + 1);
    end
    // Once cleared, or once over the top, it is a decimal digit for good.
    always @* if (legal) assert (digit <= 9);
    always @* assert (carry == (count && !clear && digit >= 9));

    always @* cover (known && carry);
    always @* cover (known && was > 9 && digit == 0);
endmodule
