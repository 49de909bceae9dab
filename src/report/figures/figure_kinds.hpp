#pragma once

#include <array>

namespace holdfast::program {

/// A kind of figure: what makes its tables and how they are drawn. In its texts @KEY@ stands for a
/// value of the figure; in commands @settings@ for options of all its tables, and @ideal@ for a
/// computer so fast that delay and hold are not seen, without backlash.
struct FigureKind {
  struct TableKind {
    const char* suffix;   ///< the table is NAME and that
    const char* command;  ///< without quotes; null: there is no such table
  };
  double height;  ///< points
  std::array<TableKind, 6> tables;
  const char* plot;  ///< as Figure's
};

namespace figure_kinds {

/// The cable at the absorber: statics, first peaks after a force is removed, one such vibration.
inline constexpr FigureKind statics = {360.0,
                                       {{{"", "statics --force @force@"}}},
                                       R"plot(set xlabel "force beyond the absorber's weight (N)"
set ylabel "displacement (mm)"
plot @@ using 1:($4*1e3) with lines ls 4 title 'spring k_1', \
  '' using 1:($3*1e3) with lines ls 2 title 'Eq. 1', \
  '' using 1:($2*1e3) with lines ls 1 title 'exact', \
  '' every 4 using 1:($5*1e3) with points pt 6 ps 0.8 lc rgb '#222222' title 'finite elements'
)plot"};

inline constexpr FigureKind peaks = {360.0,
                                     {{{"", "peaks --force 0.05:1:20 @settings@"}}},
                                     R"plot(set xlabel "force removed (N)"
set ylabel "first peak (mm)"
set y2label 'discrepancy (%)'
set y2range [0:25]
set y2tics 5 nomirror
set border 11
set yrange [0:*]
plot @@ using 1:(-$2*1e3) with points pt 6 ps 0.8 lc rgb '#222222' title 'finite elements', \
  '' using 1:(-$3*1e3) with lines ls 1 title 'two masses', \
  '' using 1:($4*100) axes x1y2 with lines ls 2 title 'discrepancy (right)'
)plot"};

inline constexpr FigureKind decay = {
    320.0,
    {{{"", "decay --force @force@ --duration @duration@ --equal-displacement"}}},
    R"plot(set xlabel "time {/:Italic t} (s)"
set ylabel "displacement (mm)"
plot @@ using 1:($2*1e3) with lines ls 1 title 'finite elements', \
  '' using 1:($3*1e3) with lines ls 2 title 'two masses'
)plot"};

/// Stable gains with @P@ and @D@, MIN:MAX each, and the curves of their boundary.
inline constexpr FigureKind stability = {
    400.0,
    {{{"-boundary", "boundary --p @P@ @settings@"},
      {"-chart", "stability --p @P@:241 --d @D@:241 @settings@"}}},
    R"plot(set xlabel "proportional gain {/:Italic P} (N/m)"
set ylabel "differential gain {/:Italic D} (N s/m)"
set xrange [@P@]
set yrange [@D@]
set palette defined (0 'white', 1 '#cfe3ef')
set cbrange [0:1]
unset colorbox
root(name) = (strcol(1) eq name ? $4 : NaN)
plot @-chart@ using 1:2:3 with image notitle, \
  keyentry with boxes fill solid lc rgb '#cfe3ef' title 'stable', \
@curves@)plot"};

inline constexpr const char* continuous_curves =
    R"plot(  @-boundary@ using 3:(root('imaginary_pair')) with lines ls 1 title 'pair {/:Italic s} = ±iω'
)plot";
inline constexpr const char* sampled_curves =
    R"plot(  @-boundary@ using 3:(root('complex_pair')) with lines ls 1 title 'pair λ = e^{±iθ}', \
  @-boundary@ using 3:(root('minus_one')) with lines ls 2 title 'root λ = −1'
)plot";

/// Three of them side by side: processing delay 0, @half@ and @tau@, half and all of the
/// sampling period.
inline constexpr FigureKind delay_charts = {
    300.0,
    {{{"-1-boundary", "boundary --p @P@ @settings@=0"},
      {"-1-chart", "stability --p @P@:161 --d @D@:161 @settings@=0"},
      {"-2-boundary", "boundary --p @P@ @settings@=@half@"},
      {"-2-chart", "stability --p @P@:161 --d @D@:161 @settings@=@half@"},
      {"-3-boundary", "boundary --p @P@ @settings@=@tau@"},
      {"-3-chart", "stability --p @P@:161 --d @D@:161 @settings@=@tau@"}}},
    R"plot(set xrange [@P@]
set yrange [@D@]
set palette defined (0 'white', 1 '#cfe3ef')
set cbrange [0:1]
unset colorbox
unset key
set xtics 400
root(name) = (strcol(1) eq name ? $4 : NaN)
set multiplot layout 1,3 margins 0.12,0.98,0.25,0.87 spacing 0.03,0
set xlabel "{/:Italic P} (N/m)"
set ylabel "{/:Italic D} (N s/m)"
set title 'δ = 0'
plot @-1-chart@ using 1:2:3 with image, \
  @-1-boundary@ using 3:(root('complex_pair')) with lines ls 1 title '', \
  @-1-boundary@ using 3:(root('minus_one')) with lines ls 2 title ''
unset ylabel
set format y ''
set title 'δ = τ/2'
plot @-2-chart@ using 1:2:3 with image, \
  @-2-boundary@ using 3:(root('complex_pair')) with lines ls 1 title '', \
  @-2-boundary@ using 3:(root('minus_one')) with lines ls 2 title ''
unset ylabel
set format y ''
set title 'δ = τ'
plot @-3-chart@ using 1:2:3 with image, \
  @-3-boundary@ using 3:(root('complex_pair')) with lines ls 1 title '', \
  @-3-boundary@ using 3:(root('minus_one')) with lines ls 2 title ''
unset ylabel
set format y ''
unset multiplot
)plot"};

/// The best D over the excitation frequency and how far it attenuates, for three computers.
inline constexpr FigureKind design = {
    440.0,
    {{{"-1", "design --frequency 3:60:229 --set control.sampling_period=0.001"},
      {"-2", "design --frequency 3:60:229 --set control.sampling_period=0.01"},
      {"-3", "design --frequency 3:60:229 --set control.sampling_period=0.02"}}},
    R"plot(set multiplot layout 2,1 margins 0.13,0.98,0.17,0.92 spacing 0,0.05
set xrange [0:60]
set yrange [-160:10]
set format x ''
set xlabel ""
set ylabel "best {/:Italic D} (N s/m)"
plot @-1@ using 1:3 with lines ls 1 title 'τ = 1 ms', \
  @-2@ using 1:3 with lines ls 2 title 'τ = 10 ms', \
  @-3@ using 1:3 with lines ls 3 title 'τ = 20 ms'
unset key
set yrange [-5:30]
set format x '%g'
set xlabel "excitation frequency {/:Italic f} (Hz)"
set ylabel "attenuation (dB)"
plot @-1@ using 1:5 with lines ls 1 title 'τ = 1 ms', \
  @-2@ using 1:5 with lines ls 2 title 'τ = 10 ms', \
  @-3@ using 1:5 with lines ls 3 title 'τ = 20 ms', \
  0 with lines lc rgb '#888888' dt 3
unset multiplot
)plot"};

/// Fig. 5; @remark@ are lines that mark something in the picture.
inline constexpr FigureKind longest_period = {
    360.0,
    {{{"-attenuates", "max-delay --criterion attenuates --frequency 3:60:115"},
      {"-stable", "max-delay --criterion stable --frequency 3:60:115"}}},
    R"plot(set xlabel "excitation frequency {/:Italic f} (Hz)"
set ylabel "largest sampling period (ms)"
set logscale y
set yrange [1:1000]
set xrange [0:60]
@remark@plot @-stable@ using 1:($3*1e3) with lines ls 4 dt 2 title 'some D stabilises', \
  @-attenuates@ using 1:($3*1e3) with lines ls 1 title 'some stabilising D attenuates'
)plot"};

inline constexpr FigureKind history = {
    320.0,
    {{{"-no-control", "simulate --duration @to@ --from @from@ @settings@ --no-control"},
      {"-ideal", "simulate --duration @to@ --from @from@ @settings@ @ideal@"},
      {"-loop", "simulate --duration @to@ --from @from@ @settings@"}}},
    R"plot(set xlabel "time {/:Italic t} (s)"
set ylabel "displacement {/:Italic z}_1 (@unit@)"
set xrange [@from@:@to@]
plot @-no-control@ using 1:($2*@length@) with lines ls 1 title 'no control', \
  @-ideal@ using 1:($2*@length@) with lines ls 2 title 'ideal control', \
  @-loop@ using 1:($2*@length@) with lines ls 3 title 'with delay and backlash'
)plot"};

inline constexpr FigureKind kick = {
    320.0,
    {{{"-undisturbed", "simulate --duration 4 @settings@"},
      {"-kicked", "simulate --duration 4 --kick @kick@ @settings@"}}},
    R"plot(set xlabel "time {/:Italic t} (s)"
set ylabel "displacement {/:Italic z}_1 (mm)"
set xrange [0:4]
plot @-kicked@ using 1:($2*1e3) with lines ls 2 title 'perturbed by 3 mm', \
  @-undisturbed@ using 1:($2*1e3) with lines ls 1 title 'undisturbed'
)plot"};

/// Relative velocity and, as @contact@ on the axes of @axes@, whether the drive transmits.
inline constexpr FigureKind contact = {
    320.0,
    {{{"", "simulate --duration @to@ --from @from@ @settings@"}}},
    R"plot(set xlabel "time {/:Italic t} (s)"
set ylabel "relative velocity {/:Italic v}_2 − {/:Italic v}_1 (m/s)"
set xrange [@from@:@to@]
@axes@plot @@ using 1:($5-$3) with lines ls 1 title 'v_2 − v_1', \
  '' using @contact@
)plot"};

inline constexpr FigureKind phase = {
    420.0,
    {{{"-no-control", "simulate --duration 30.3 --from 30 --no-control @ideal@"},
      {"-ideal", "simulate --duration 30.3 --from 30 @ideal@"},
      {"-loop", "simulate --duration @duration@ --from 30 @settings@"}}},
    R"plot(set xlabel "displacement {/:Italic z}_1 (@unit@)"
set ylabel "velocity {/:Italic v}_1 (m/s)"
plot @-no-control@ using ($2*@length@):3 with lines ls 1 title 'no control', \
  @-loop@ using ($2*@length@):3 with lines lw 0.8 lc rgb '#009e73' title 'with delay and backlash', \
  @-ideal@ using ($2*@length@):3 with lines ls 2 title 'ideal control'
)plot"};

inline constexpr FigureKind spectrum = {320.0,
                                        {{{"", "spectrum --duration 100 --discard 40 @settings@"}}},
                                        R"plot(set xlabel "frequency {/:Italic f} (Hz)"
set ylabel "amplitude of {/:Italic z}_1 (m)"
set logscale y
set format y '10^{%L}'
set xrange [0:45]
set yrange [1e-8:2e-3]
unset key
plot @@ using 1:($2 > 1e-8 ? $2 : 1e-8) with impulses ls 1
)plot"};

inline constexpr FigureKind deviation = {
    320.0,
    {{{"", "deviation --offset 1e-5 --duration 30 @settings@"}}},
    R"plot(set xlabel "time {/:Italic t} (s)"
set ylabel "|{/:Italic z}_{1,b} − {/:Italic z}_{1,a}| (m)"
set logscale y
set format y '10^{%L}'
set yrange [1e-18:1e-2]
unset key
plot @@ using 1:(abs($2) > 0 ? abs($2) : 1e-18) with lines ls 1 lw 0.6
)plot"};

inline constexpr FigureKind filling = {320.0,
                                       {{{"", "simulate --duration @duration@ @settings@"}}},
                                       R"plot(set xlabel "displacement {/:Italic z}_1 (mm)"
set ylabel "velocity {/:Italic v}_1 (m/s)"
set xrange [0:1]
set yrange [-0.05:0.05]
unset key
plot @@ using ($2 > 0 && $2 < 1e-3 && abs($3) < 0.05 ? $2*1e3 : NaN):3 with points pt 7 ps 0.3 lc rgb '#0072b2'
)plot"};

/// The exponents with the tangent @tangent@ as they settle, in @range@ from @from@ (s) on.
inline constexpr FigureKind exponents = {
    320.0,
    {{{"", "lyapunov --duration 10 --history --tangent @tangent@ @settings@"}}},
    R"plot(set xlabel "time {/:Italic t} (s)"
set ylabel "exponent {/:Italic λ} per sample"
set xrange [@from@:10]
set yrange [@range@]
plot for [i=1:3] @@ every 5 using ($1 >= @from@ ? $1 : NaN):(column(i+1)) with lines ls i title sprintf('λ_%d', i), 0 with lines lc rgb '#888888' dt 3 notitle
)plot"};

/// Those of Table 2 beside the paper's, @published@: a line each, number and exponent.
inline constexpr FigureKind exponent_table = {
    320.0,
    {{{"-printed", "lyapunov --duration @duration@ --tangent printed @settings@"},
      {"-consistent", "lyapunov --duration @duration@ --tangent consistent @settings@"}}},
    R"plot($published << END
@published@END
set xlabel "number of the exponent"
set ylabel "exponent {/:Italic λ} per sample"
set xrange [0.5:4.5]
set xtics 1
set bars 0.5
plot @-printed@ using ($1-0.12):2:4 with yerrorbars ls 1 dt 1 pt 7 ps 0.7 title 'tangent as printed, δ = τ', \
  @-consistent@ using ($1+0.12):2:4 with yerrorbars ls 2 dt 1 pt 5 ps 0.7 title 'consistent tangent, δ = 0', \
  $published using 1:2 with points pt 2 ps 1.2 lw 1.6 lc rgb '#444444' title 'paper'
)plot"};

/// Two exact orbits in the phase plane, side by side.
inline constexpr FigureKind orbits = {
    360.0,
    {{{"-1", "orbit --trace @slow@"}, {"-2", "orbit --trace @fast@"}}},
    R"plot(unset key
set multiplot layout 1,2 margins 0.14,0.97,0.21,0.88 spacing 0.12,0
set title "τ = 11 ms"
set xlabel "displacement {/:Italic z}_1 (mm)"
set ylabel "velocity {/:Italic v}_1 (m/s)"
plot @-1@ using ($2*1e3):3 with lines lw 0.4 lc rgb '#56b4e9', \
  '' using ($2*1e3):3 with points pt 7 ps 0.18 lc rgb '#0072b2'
set title "τ = 1 ms"
set xlabel "displacement {/:Italic z}_1 (mm)"
set ylabel ""
plot @-2@ using ($2*1e3):3 with lines lw 0.4 lc rgb '#56b4e9', \
  '' using ($2*1e3):3 with points pt 7 ps 0.18 lc rgb '#0072b2'
unset multiplot
)plot"};

/// Poincaré section Δż = 0 of one period of the motion, in the phase plane.
inline constexpr FigureKind section = {400.0,
                                       {{{"", "section --duration 53.1 --from 30 @settings@"}}},
                                       R"plot(set xlabel "displacement {/:Italic z}_1 (mm)"
set ylabel "common velocity {/:Italic v}_1 = {/:Italic v}_2 (m/s)"
plot @@ using ($5 == 1 ? $2*1e3 : NaN):3 with points pt 7 ps 0.4 lc rgb '#0072b2' title 'absorber turns downward', \
  '' using ($5 == 0 ? $2*1e3 : NaN):3 with points pt 6 ps 0.5 lc rgb '#d55e00' title 'turns upward'
)plot"};

/// z₁ once every forcing period, the key of @axis@ going up and back, shown @scale@ times.
inline constexpr FigureKind diagram = {480.0,
                                       {{{"", "diagram --axis @axis@ --strobes 20 @settings@"}}},
                                       R"plot(stats @@ using 3 nooutput
unset key
set multiplot layout 2,1 margins 0.13,0.97,0.15,0.93 spacing 0,0.09
set autoscale xfix
set yrange [floor(2e3*STATS_min)/2.0:ceil(2e3*STATS_max)/2.0]
set format x ''
set title 'on the way up' offset 0,-0.6
set xlabel ""
set ylabel "{/:Italic z}_1 (mm)"
plot @@ using ($1*@scale@):($2 == 1 ? $3*1e3 : NaN) with points pt 7 ps 0.2 lc rgb '#0072b2'
set format x '%g'
set title 'on the way back'
set xlabel "@label@"
set ylabel "{/:Italic z}_1 (mm)"
plot @@ using ($1*@scale@):($2 == 0 ? $3*1e3 : NaN) with points pt 7 ps 0.2 lc rgb '#d55e00'
unset multiplot
)plot"};

/// Basins over initial.z1 and initial.z2; the legend, collected from the table of shares, has the
/// period and share of each attractor. Colours of M. Okabe and K. Ito; black: no orbit found, grey:
/// diverges, then one an attractor. Those of the first attractors differ in lightness too.
inline constexpr FigureKind basins = {
    520.0,
    {{{"-states", "basins --axis initial.z1=@range@ --axis initial.z2=@range@ @settings@"},
      {"-shares",
       "basins --axis initial.z1=@range@ --axis initial.z2=@range@ @settings@ --fractions"}}},
    R"plot(numbers = ''
texts = ''
fate(k, period, share) = (k < 0 ? 'no orbit found' : k == 0 ? 'diverges' : sprintf('period %.3g s', period)).sprintf(': %.3g %%', 100*share)
note(k, period, share) = (numbers = numbers.sprintf('%d ', k), texts = texts.'"'.fate(k, period, share).'" ', k)
stats @-shares@ using (note($1, $3, $7)) nooutput
set palette maxcolors 10
set palette defined (-1 '#000000', 0 '#bbbbbb', 1 '#0072b2', 2 '#f0e442', 3 '#e69f00', 4 '#009e73', 5 '#cc79a7', 6 '#56b4e9', 7 '#d55e00', 8 '#666666')
set cbrange [-1.5:8.5]
unset colorbox
set xlabel "initial displacement of the conductor {/:Italic z}_1 (mm)"
set ylabel "initial displacement of the absorber {/:Italic z}_2 (mm)"
set size ratio -1
set autoscale fix
set tics out
set key outside top center horizontal maxcols 2 samplen 1 spacing 1.3
plot @-states@ using ($1*1e3):($2*1e3):3 with image notitle, \
  for [k=1:words(numbers)] keyentry with points pt 5 ps 1.6 lc palette cb (word(numbers, k) > 8 ? 8 : word(numbers, k)) title word(texts, k)
)plot"};

}  // namespace figure_kinds
}  // namespace holdfast::program
