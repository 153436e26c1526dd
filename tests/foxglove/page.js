// Foxglove Studio with one layout: that of the file `layout` which the address names, else a plot of the fields that it asks for, and
// the number of the message at the time shown. What it shows: `file`, or the server that `live` names.
const asked = new URLSearchParams(location.search);
const fields = asked.getAll("field");
const numbers = fields.length > 0 ? fields[0].split(".")[0] + ".seq" : "";

const plot = {
  paths: fields.map((value) => ({ value, enabled: true, timestampMethod: "receiveTime" })),
  xAxisVal: "timestamp", showXAxisLabels: true, showYAxisLabels: true, isSynced: true,
  showLegend: true, legendDisplay: "top", showPlotValuesInLegend: true, sidebarDimension: 240,
};
const messages = { topicPath: numbers, diffEnabled: false, diffMethod: "custom", diffTopicPath: "", showFullMessageForDiff: false };
const layout = {
  id: asked.get("layoutId"), name: "sprung", permission: "CREATOR_WRITE",
  baseline: {
    savedAt: new Date().toISOString(),
    data: {
      configById: { "Plot!a": plot, "RawMessages!b": messages },
      globalVariables: {}, userNodes: {}, playbackConfig: { speed: 1 },
      layout: { direction: "row", first: "Plot!a", second: "RawMessages!b", splitPercentage: 75 },
    },
  },
};

if (asked.has("layout")) layout.baseline.data = await (await fetch(asked.get("layout"))).json();
const layouts = new Map([[layout.id, layout]]);
const layoutStorage = {
  list: async () => [...layouts.values()],
  get: async (_, id) => layouts.get(id),
  put: async (_, changed) => (layouts.set(changed.id, changed), changed),
  delete: async (_, id) => void layouts.delete(id),
  importLayouts: async () => {},
};

const settings = new Map([["telemetry.telemetryEnabled", false], ["telemetry.crashReportingEnabled", false], ["timezone", "UTC"], ["colorScheme", "light"]]);
const appConfiguration = {
  get: (key) => settings.get(key),
  set: async (key, value) => void settings.set(key, value),
  addChangeListener() {},
  removeChangeListener() {},
};

const link = new URL(location.origin);
const source = asked.has("live") ? { ds: "foxglove-websocket", "ds.url": asked.get("live") }
  : { ds: "remote-file", "ds.url": location.origin + "/" + asked.get("file") };
link.search = new URLSearchParams({ ...source, layoutId: layout.id });
initI18n({ context: "browser" }).then(() =>
  ReactDOM.render(
    React.createElement(App, {
      deepLinks: [link.href], appConfiguration, layoutStorage, extensionLoaders: [], enableGlobalCss: true,
      dataSources: [new RemoteDataSourceFactory(), new FoxgloveWebSocketDataSourceFactory()],
    }),
    document.getElementById("root"),
  ),
);
