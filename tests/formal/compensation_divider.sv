// One pulse for every F, for every F from 1000 to 9 999 000; none when the wheels show 0000.

module compensation_divider_proof(input clock, input clear, input pulse, input [15:0] preset);
    wire due;
    compensation_divider dut(.clock(clock), .clear(clear), .pulse(pulse), .preset(preset), .due(due));

    (* hierconn *) wire [3:0] \dut.units.state_q ;
    (* hierconn *) wire [3:0] \dut.tens.state_q ;
    (* hierconn *) wire [3:0] \dut.hundreds.state_q ;
    (* hierconn *) wire [3:0] \dut.thousands.state_q ;
    (* hierconn *) wire [3:0] \dut.ten_thousands.state_q ;
    (* hierconn *) wire [3:0] \dut.hundred_thousands.state_q ;
    (* hierconn *) wire [3:0] \dut.millions.state_q ;

    // The same count in decimals of its own: a reference that never clears itself.
    reg [27:0] decimal;
    reg [15:0] wheels;
    reg known = 0;
    wire [27:0] shown = { \dut.millions.state_q , \dut.hundred_thousands.state_q ,
        \dut.ten_thousands.state_q , \dut.thousands.state_q , \dut.hundreds.state_q ,
        \dut.tens.state_q , \dut.units.state_q };

    function [27:0] one_more(input [27:0] n);
        if (n[3:0] != 9) one_more = n + 1;
        else if (n[7:4] != 9) one_more = {n[27:8], n[7:4] + 4'd1, 4'd0};
        else if (n[11:8] != 9) one_more = {n[27:12], n[11:8] + 4'd1, 8'd0};
        else if (n[15:12] != 9) one_more = {n[27:16], n[15:12] + 4'd1, 12'd0};
        else if (n[19:16] != 9) one_more = {n[27:20], n[19:16] + 4'd1, 16'd0};
        else if (n[23:20] != 9) one_more = {n[27:24], n[23:20] + 4'd1, 20'd0};
        else one_more = {n[27:24] + 4'd1, 24'd0};
    endfunction
    wire [27:0] counted = pulse ? one_more(decimal) : decimal;

    always @* begin
        assume (preset[3:0] <= 9 && preset[7:4] <= 9 && preset[11:8] <= 9 && preset[15:12] <= 9);
        if (known && !clear) assume (wheels == preset);
    end
    always @(posedge clock) begin
        wheels <= preset;
        if (clear) known <= 1;
        if (clear || preset == 0) decimal <= 0;
        else if (due) decimal <= pulse;
        else decimal <= counted;
    end

    always @* if (known && !clear) begin
        assert (shown == decimal);
        assert (decimal[3:0] <= 9 && decimal[7:4] <= 9 && decimal[11:8] <= 9);
        assert (decimal[15:12] <= 9 && decimal[19:16] <= 9 && decimal[23:20] <= 9);
        // In decimals as in binary, below F is below F digit by digit from the top.
        assert (decimal <= {preset, 12'd0});
        assert (due == (preset != 0 && decimal == {preset, 12'd0}));
    end

    always @* cover (known && decimal == 28'h0000012);
endmodule
