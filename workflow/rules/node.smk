# Neural ODEs on trained autoencoders; each output folder holds all that a forecast needs.


rule train_node:
    input:
        training=split_files("train"),
        autoencoder=lambda wildcards: model_files(autoencoder_of(wildcards.model)),
    output:
        model_files("results/models/node/{model}"),
    log:
        "results/logs/train_node/{model}.log",
    resources:
        mem_mb=3000,
        runtime=60,
    params:
        code=code_of("train_node"),
        autoencoder=lambda wildcards: autoencoder_of(wildcards.model),
        settings=lambda wildcards: as_json(STUDY.node_settings(wildcards.model)),
        folder=lambda wildcards, output: Path(output[0]).parent,
    shell:
        "sedfiber train_node {input.training} --autoencoder {params.autoencoder}"
        " --settings {params.settings:q} -o {params.folder} 2>&1 | tee {log}"


rule choose_forecast_model:
    input:
        model_files(f"results/models/node/{config['node']['forecast_model']}"),
        "results/terminal_shapes/terminal_curve.parquet",
    output:
        model_files("results/models/forecast"),
        "results/models/forecast/terminal_curve.parquet",
    log:
        "results/logs/choose_forecast_model.log",
    shell:
        "cp {input} results/models/forecast/ > {log} 2>&1"


rule node:
    input:
        [model_files(f"results/models/node/{model}") for model in NODES],
        rules.choose_forecast_model.output,
