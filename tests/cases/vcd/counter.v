// Producer of the dumps beside it: hierarchy, aliases through ports, x and z, vectors, a real.
`timescale 1ns / 100ps
module counter(input clock, input clear, output reg [11:0] count, output zero);
    assign zero = count == 0;
    always @(posedge clock) if (clear) count <= 0; else count <= count + 12'd37;
endmodule

module bench;
    reg clock = 0, clear;
    wire [11:0] count;
    wire zero;
    wire bus;
    reg drive = 0;
    real error_um = 0.125;
    counter dut(.clock(clock), .clear(clear), .count(count), .zero(zero));
    assign bus = drive ? count[0] : 1'bz;
    always #41.7 clock = ~clock;
    always @(posedge clock) error_um = error_um * -1.0625;
    initial begin
        $dumpfile("counter.vcd");
        $dumpvars(0, bench);
        #130 clear = 1;
        #200 clear = 0; drive = 1;
        #900 drive = 0;
        #3000 $finish;
    end
endmodule
