// Draws the plots of a report with Chart.js from the data that tools/common/report/report.cpp wrote into the page.
'use strict';
(() => {
  // Okabe and Ito's colours for every kind of colour vision, without the yellow, which white paper swallows.
  const COLOURS = ['#0072B2', '#D55E00', '#009E73', '#CC79A7', '#E69F00', '#56B4E9', '#000000'];
  const SHADES = ['#E3EEF8', '#FDF0DC', '#E4F4EA', '#F6E9F1', '#EEEEEE', '#FBF7D9', '#EAE6F7',
    '#DDEFF2', '#E9EDD3', '#F8E0D8', '#DDDDE8'];
  const INK = '#333333';
  const MANY_PLOTS = 24;  // past these, drawing at twice the resolution for paper takes too much memory
  const FINGER_PX = 20;   // how near the pointer must be to a point of a cloud
  const SHADE_NAMES_PX = 16, MARKER_NAME_PX = 14;

  // A page that is opened as x.html#picture fits its plots into the window, as a picture of it wants them (report.css).
  const picture = location.hash === '#picture';
  if (picture) document.documentElement.className = 'picture';

  const colour = index => COLOURS[index % COLOURS.length];
  // The second time round the palette a line is dotted.
  const dash = series =>
    series.style === 'dashed' ? [6, 4] : series.colour >= COLOURS.length ? [2, 3] : [];
  const points = (x, y) => x.map((value, i) => ({x: value ?? NaN, y: y[i] ?? NaN}));
  const short = value => String(Number(value.toPrecision(6)));
  const ascending = x => x.every((value, i) => i === 0 || value >= x[i - 1]);

  function seriesDataset(series) {
    const cloud = series.style === 'points';
    const radius = !cloud ? 0 : series.x.length < 200 ? 3 : 1.6;
    return {
      type: 'scatter', label: series.name, data: points(series.x, series.y), showLine: !cloud, order: cloud ? 2 : series.style === 'dashed' ? 0 : 1,
      borderColor: colour(series.colour), backgroundColor: colour(series.colour) + (cloud ? '99' : ''),
      borderWidth: cloud ? 0 : 1.8, borderDash: dash(series), borderJoinStyle: 'round', pointRadius: radius, pointHoverRadius: cloud ? radius + 2 : 3, overTime: !cloud && ascending(series.x),
    };
  }

  function bandDatasets(band) {
    const edge = {
      type: 'scatter', showLine: true, order: 3, borderWidth: 0, pointRadius: 0, pointHoverRadius: 0, overTime: true,
      borderColor: colour(band.colour), backgroundColor: colour(band.colour) + '40',
    };
    return [
      {...edge, label: band.name, data: points(band.x, band.high), fill: '+1', edge: 'high'},
      {...edge, label: band.name, data: points(band.x, band.low), fill: false, edge: 'low'},
    ];
  }

  // The nearest sample of every curve at the pointer's x; of clouds and paths only what is under the pointer.
  Chart.Interaction.modes.nearestOfEach = (chart, event) => {
    const found = [];
    for (const meta of chart.getSortedVisibleDatasetMetas()) {
      const overTime = chart.data.datasets[meta.index].overTime;
      let best = overTime ? Infinity : FINGER_PX, index = -1;
      meta.data.forEach((point, i) => {
        const away = overTime ? Math.abs(point.x - event.x) : Math.hypot(point.x - event.x, point.y - event.y);
        if (!point.skip && away < best) [best, index] = [away, i];
      });
      if (index >= 0) found.push({element: meta.data[index], datasetIndex: meta.index, index});
    }
    return found;
  };

  const shadeColours = shades => {
    const names = [...new Set(shades.map(shade => shade.name))];
    return new Map(names.map((name, i) => [name, SHADES[i % SHADES.length]]));
  };

  function drawShades(chart, plot) {
    const {ctx, chartArea: area, scales: {x}} = chart;
    const colours = shadeColours(plot.shades);
    for (const shade of plot.shades) {
      const left = Math.max(area.left, x.getPixelForValue(shade.from ?? x.min));
      const right = Math.min(area.right, x.getPixelForValue(shade.to ?? x.max));
      if (right <= left) continue;
      ctx.fillStyle = colours.get(shade.name);
      ctx.fillRect(left, area.top, right - left, area.bottom - area.top);
      ctx.fillStyle = INK;
      ctx.textAlign = 'center';
      if (ctx.measureText(shade.name).width + 4 < right - left) {
        ctx.fillText(shade.name, (left + right) / 2, area.top - 4);
      }
    }
  }

  // Names of markers that are close to each other stand below one another.
  function drawMarkers(chart, plot) {
    const {ctx, chartArea: area, scales: {x}} = chart;
    let lastAt = -Infinity, top = 0;
    for (const marker of [...plot.markers].sort((a, b) => a.x - b.x)) {
      const at = x.getPixelForValue(marker.x);
      if (!(at >= area.left && at <= area.right)) continue;
      ctx.setLineDash([4, 3]);
      ctx.strokeStyle = ctx.fillStyle = INK;
      ctx.beginPath();
      ctx.moveTo(at, area.top);
      ctx.lineTo(at, area.bottom);
      ctx.stroke();
      ctx.save();
      top = at - lastAt < MARKER_NAME_PX ? top : area.top + 4;
      ctx.translate(at + (at + MARKER_NAME_PX < area.right ? MARKER_NAME_PX - 2 : -4), top);
      ctx.rotate(-Math.PI / 2);
      ctx.textAlign = 'right';
      ctx.fillText(marker.name, 0, 0);
      [lastAt, top] = [at, top + ctx.measureText(marker.name).width + 10];
      ctx.restore();
    }
  }

  function drawSelection(chart) {
    if (!chart.selection) return;
    const {ctx, chartArea: area, selection: {from, to}} = chart;
    ctx.fillStyle = 'rgba(0, 114, 178, 0.15)';
    ctx.fillRect(Math.min(from, to), area.top, Math.abs(to - from), area.bottom - area.top);
  }

  // Restores the canvas' state around what we paint ourselves.
  const painted = paint => chart => {
    chart.ctx.save();
    chart.ctx.font = '11px system-ui, sans-serif';
    paint(chart);
    chart.ctx.restore();
  };

  // For the test in a real browser: how many points are to be seen.
  function tellWhatIsDrawn(chart) {
    const {left, right} = chart.chartArea;
    const seen = point => !point.skip && point.x >= left - 1 && point.x <= right + 1 && isFinite(point.y);
    const metas = chart.getSortedVisibleDatasetMetas();
    const count = metas.reduce((sum, meta) => sum + meta.data.filter(seen).length, 0);
    chart.canvas.dataset.drawn = count;
  }

  const decoration = plot => ({
    id: 'decoration',
    beforeDatasetsDraw: painted(chart => drawShades(chart, plot)),
    afterDatasetsDraw: painted(chart => drawMarkers(chart, plot)),
    afterDraw(chart) {
      painted(drawSelection)(chart);
      tellWhatIsDrawn(chart);
    },
  });

  const axis = (text, grace) => ({
    type: 'linear', grace, title: {display: true, text, color: INK, font: {size: 13}},
    ticks: {color: INK, includeBounds: false, format: {useGrouping: false, maximumSignificantDigits: 6}}, grid: {color: '#DDDDDD'},
  });

  function tooltip(plot) {
    const label = item => {
      const {label: name, edge} = item.dataset;
      return `${name}${edge ? ', ' + edge : ''}: ` + (item.dataset.overTime ? '' : short(item.parsed.x) + ', ') + short(item.parsed.y);
    };
    const title = items => items.length && items[0].dataset.overTime ? `${plot.x}: ${short(items[0].parsed.x)}` : `${plot.x}, ${plot.y}`;
    return {animation: false, callbacks: {title, label}};
  }

  // From the first to the last x, with a little room beside clouds: no empty stretch left and right, and round numbers at the ticks.
  function extent(plot) {
    const values = [...plot.series, ...plot.bands].flatMap(curve => curve.x).filter(value => value !== null);
    const [min, max] = values.reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]);
    if (!(max > min)) return {};
    const room = plot.series.some(curve => curve.style === 'points') ? 0.01 * (max - min) : 0;
    return {min: min - room, max: max + room};
  }

  const options = (plot, plotCount) => ({
    animation: false, responsive: true, maintainAspectRatio: false, locale: 'en-US',
    devicePixelRatio: Math.max(window.devicePixelRatio, plotCount > MANY_PLOTS ? 1 : 2),
    interaction: {mode: 'nearestOfEach'},
    scales: {x: {...axis(plot.x), ...extent(plot)}, y: axis(plot.y, '4%')},
    layout: {padding: {top: plot.shades.length > 0 ? SHADE_NAMES_PX : 4}},
    plugins: {tooltip: tooltip(plot), legend: {display: false}},
  });

  // Widens the axis that has more room, until a unit is as long in x as in y.
  function equalise(chart, full) {
    const {width, height} = {width: chart.chartArea.right - chart.chartArea.left, height: chart.chartArea.bottom - chart.chartArea.top};
    const perPixel = 1.05 * Math.max((full.x[1] - full.x[0]) / width, (full.y[1] - full.y[0]) / height) || 1;
    for (const [name, length] of [['x', width], ['y', height]]) {
      const middle = (full[name][0] + full[name][1]) / 2;
      Object.assign(chart.options.scales[name], {min: middle - perPixel * length / 2, max: middle + perPixel * length / 2});
    }
    chart.update();
  }

  function keepEqual(chart) {
    const full = {x: [chart.scales.x.min, chart.scales.x.max], y: [chart.scales.y.min, chart.scales.y.max]};
    for (let i = 0; i < 2; ++i) equalise(chart, full);  // the first changes the room that the numbers take
    chart.options.onResize = () => equalise(chart, full);
  }

  // Dragging shows a stretch of x in every plot of the section with this x axis; a double click shows all again.
  function zoomable(chart, group) {
    const {canvas} = chart;
    const inside = event => Math.min(Math.max(event.offsetX, chart.chartArea.left), chart.chartArea.right);
    const show = stretch => group().forEach(other => {
      Object.assign(other.options.scales.x, stretch ?? other.everything);
      other.update();
    });
    canvas.addEventListener('pointerdown', event => {
      if (event.button !== 0) return;
      canvas.setPointerCapture(event.pointerId);
      chart.selection = {from: inside(event), to: inside(event)};
    });
    canvas.addEventListener('pointermove', event => {
      if (!chart.selection) return;
      chart.selection.to = inside(event);
      chart.draw();
    });
    canvas.addEventListener('pointerup', () => {
      if (!chart.selection) return;
      const ends = [chart.selection.from, chart.selection.to].sort((a, b) => a - b);
      chart.selection = null;
      if (ends[1] - ends[0] <= 5) return;
      const [min, max] = ends.map(end => chart.scales.x.getValueForPixel(end));
      show({min, max});
    });
    canvas.addEventListener('dblclick', () => show());
  }

  function add(parent, tag, className, text) {
    const element = document.createElement(tag);
    element.className = className;
    element.textContent = text;
    return parent.appendChild(element);
  }

  // What a curve looks like, 28 pixels wide.
  function glyph(dataset) {
    const {borderColor: ink, backgroundColor: fill, borderDash = [], edge, showLine} = dataset;
    const shape = edge ? `<rect width="28" height="12" fill="${fill}"/>`
      : showLine ? `<path d="M0 6h28" stroke="${ink}" stroke-width="2.4" stroke-dasharray="${borderDash}"/>`
      : `<circle cx="14" cy="6" r="4" fill="${ink}"/>`;
    return `<svg width="28" height="12" aria-hidden="true">${shape}</svg>`;
  }

  // A band is two curves with one entry in the legend.
  function legend(chart, figure) {
    const list = document.createElement('div');
    list.className = 'legend';
    figure.insertBefore(list, chart.canvas.parentElement);
    chart.data.datasets.forEach((dataset, i) => {
      if (dataset.edge === 'low') return;
      const entry = add(list, 'button', '', dataset.label);
      entry.insertAdjacentHTML('afterbegin', glyph(dataset));
      entry.addEventListener('click', () => {
        const show = !chart.isDatasetVisible(i);
        for (let k = i; k <= i + (dataset.edge ? 1 : 0); ++k) chart.setDatasetVisibility(k, show);
        entry.classList.toggle('hidden', !show);
        chart.update();
      });
    });
  }

  function explain(figure, plot) {
    if (plot.shades.length > 0) {
      const key = add(figure, 'p', 'key', '');
      for (const [name, shade] of shadeColours(plot.shades)) add(key, 'span', '', name).style.borderColor = shade;
    }
    const thinned = [...plot.series, ...plot.bands].filter(curve => curve.x.length < curve.samples);
    if (thinned.length === 0) return;
    const most = Math.max(...thinned.map(curve => curve.samples));
    add(figure, 'p', 'thinned', `Thinned for the screen from up to ${most} samples a curve, keeping peaks and gaps.`);
  }

  function draw(canvas, plot, plotCount) {
    const datasets = [...plot.series.map(seriesDataset), ...plot.bands.flatMap(bandDatasets)];
    const chart = new Chart(canvas, {data: {datasets}, options: options(plot, plotCount), plugins: [decoration(plot)]});
    chart.everything = {min: undefined, max: undefined, ...extent(plot)};
    if (plot.equal) keepEqual(chart);
    legend(chart, canvas.closest('figure'));
    explain(canvas.closest('figure'), plot);
    return chart;
  }

  const plots = JSON.parse(document.getElementById('plots').textContent);
  const canvases = [...document.querySelectorAll('canvas[data-plot]')];
  const charts = canvases.map(canvas => draw(canvas, plots[canvas.dataset.plot], plots.length));
  if (picture) charts.forEach(chart => chart.resize());  // at once: legends have taken their room since
  const sameAxis = (a, b) => plots[a].x === plots[b].x && !plots[b].equal &&
    canvases[a].closest('section') === canvases[b].closest('section');
  charts.forEach((chart, i) => {
    if (!plots[i].equal) zoomable(chart, () => charts.filter((other, k) => sameAxis(i, k)));
  });
  window.addEventListener('beforeprint', () => document.querySelectorAll('details').forEach(details => details.open = true));
})();
