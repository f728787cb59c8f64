"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const style = getComputedStyle(document.documentElement);
  const colors = ["--a", "--b"].map((name) => style.getPropertyValue(name).trim());
  const widths = [4.2, 1.8]; // B is drawn over A: the wider A stays visible where the two agree
  const graphs = [];

  function floats(text) {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    return new Float32Array(bytes.buffer);
  }

  function number(value) {
    if (value === 0) return "0";
    const size = Math.abs(value);
    return size >= 1e5 || size < 1e-3 ? value.toExponential(3) : String(Number(value.toPrecision(5)));
  }

  function element(tag, className, text) {
    const node = document.createElement(tag);
    if (className) node.className = className;
    if (text) node.textContent = text;
    return node;
  }

  // Rows [t, a, b] over the union of the instants of both runs; null where a run has none.
  function merge(curves) {
    const rows = [];
    const at = curves.map(() => 0);
    for (;;) {
      const next = curves.map((c, i) => (at[i] < c.time.length ? c.time[at[i]] : Infinity));
      const time = Math.min(...next);
      if (time === Infinity) return rows;
      rows.push([time, ...curves.map((c, i) => (next[i] === time ? c.values[at[i]++] : null))]);
    }
  }

  // Room above and below; noise about a constant is not blown up to the height of the plot.
  function valueRange(curves) {
    let low = Infinity, high = -Infinity;
    for (const curve of curves)
      for (const v of curve.values) {
        if (v < low) low = v;
        if (v > high) high = v;
      }
    if (!(high >= low)) return [-1, 1];
    const least = 1e-6 * Math.max(Math.abs(low), Math.abs(high)) + 1e-9;
    const room = high - low > least ? 0.06 * (high - low) : Math.max(1e-3, 0.01 * Math.abs(high));
    return [low - room, high + room];
  }

  function legend(at) {
    const time = at.x === undefined ? "" : `<span>t = ${number(at.x)} s</span>`;
    return time + at.series.map((s) => {
      const value = s.y === undefined || s.y === null ? "" : " " + number(s.y);
      return `<span><i style="border-color:${s.color}"></i>${s.labelHTML}${value}</span>`;
    }).join("");
  }

  // One graph's time window and cursor become those of all.
  let following = false;
  function lead(leader, action) {
    if (following) return;
    following = true;
    for (const graph of graphs) if (graph !== leader) action(graph);
    following = false;
  }
  const followWindow = (me, initial) => {
    if (!initial) lead(me, (graph) => graph.updateOptions({ dateWindow: me.xAxisRange() }));
  };
  function nearestRow(graph, time) {
    let low = 0, high = graph.numRows() - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (graph.getValue(middle, 0) < time) low = middle + 1; else high = middle;
    }
    return low;
  }

  function draw(parent, plot) {
    const curves = [plot.a, plot.b]
      .map((values, i) => values && { time: floats(data.times[i]), values: floats(values), i })
      .filter(Boolean);
    const figure = parent.appendChild(element("figure"));
    const caption = figure.appendChild(element("figcaption"));
    caption.append(element("b", "", plot.title), element("span", "unit", plot.unit && `[${plot.unit}]`));
    if (plot.note) caption.append(element("span", "note", plot.note));
    const values = figure.appendChild(element("div", "legend"));
    const area = figure.appendChild(element("div", "plot"));

    const names = data.titles[0] === data.titles[1] ? data.titles.map((t, i) => `${t} (${"AB"[i]})`) : data.titles;
    const series = {};
    for (const c of curves) series[names[c.i]] = { color: colors[c.i], strokeWidth: widths[c.i] };
    graphs.push(new Dygraph(area, merge(curves), {
      labels: ["time", ...curves.map((c) => names[c.i])],
      series,
      valueRange: valueRange(curves),
      connectSeparatedPoints: true,
      labelsDiv: values,
      legend: "always",
      legendFormatter: legend,
      xlabel: "time [s]",
      xLabelHeight: 15,
      rightGap: 12,
      gridLineColor: "#dde2e8",
      axisLineColor: "#b9c0c9",
      highlightCircleSize: 3,
      axes: {
        x: { axisLabelFormatter: number, pixelsPerLabel: 70 },
        y: { axisLabelFormatter: number, axisLabelWidth: 62, pixelsPerLabel: 26 },
      },
      drawCallback: followWindow,
      highlightCallback(event, x) { lead(this, (graph) => graph.setSelection(nearestRow(graph, x))); },
      unhighlightCallback() { lead(this, (graph) => graph.clearSelection()); },
    }));
  }

  // A drawing that was made with the page.
  function show(parent, picture) {
    const figure = parent.appendChild(element("figure", "picture"));
    const caption = figure.appendChild(element("figcaption"));
    caption.append(element("b", "", picture.title), element("span", "unit", `[${picture.unit}]`));
    figure.insertAdjacentHTML("beforeend", picture.svg);
  }

  const page = document.getElementById("plots");
  for (const section of data.sections) {
    const part = page.appendChild(element("section"));
    part.appendChild(element("h2", "", section.heading));
    if (section.note) part.appendChild(element("p", "caption", section.note));
    const columns = section.plots.length % 3 === 0 && section.pictures.length === 0 ? "three" : "two";
    const grid = part.appendChild(element("div", "grid " + columns));
    for (const plot of section.plots) draw(grid, plot);
    for (const picture of section.pictures) show(grid, picture);
  }
})();
