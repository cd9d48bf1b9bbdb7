// Square wave of half a comparison period, from the grating (fig. 16)

`default_nettype none

module standard_wave (
    input  wire         clock,
    input  wire         clear,
    input  wire         divided,
    input  wire         start,
    input  wire         half,
    input  wire         range_x2,
    output wire         standard
);

    reg middle;
    reg wave_d;
    reg wave_q;

    always @* begin
        if (range_x2) begin
            middle = divided;
        end else begin
            middle = half;
        end
    end

    always @* begin
        wave_d = wave_q;
        if (clear) begin
            wave_d = 1'b0;
        end else if (start) begin
            wave_d = 1'b1;
        end else if (middle) begin
            wave_d = 1'b0;
        end
    end

    assign standard = wave_q;

    initial begin
        wave_q = 1'b0;
    end

    always @(posedge clock) begin
        wave_q <= wave_d;
    end
endmodule

`default_nettype wire
